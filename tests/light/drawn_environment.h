#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/light/environment.h"

namespace prt::test {

/// A layout and its shape in cells.
struct Shape {
    SphereMap map;
    int columnCount;
    int rowCount;
};

inline constexpr Shape kShapes[] = {
    {SphereMap::latLong, 2, 1},       {SphereMap::angularMap, 1, 1},
    {SphereMap::verticalCross, 3, 4}, {SphereMap::horizontalCross, 4, 3},
    {SphereMap::verticalStrip, 1, 6}, {SphereMap::horizontalStrip, 6, 1},
    {SphereMap::octahedral, 1, 1},
};

/// Draws a function of direction; what a map does not show stays NaN,
/// so that its use would be seen.
template <class Function>
Environment draw(const Shape& shape, int cellSize, Function radiance) {
    const int width = shape.columnCount * cellSize, height = shape.rowCount * cellSize;
    Environment environment{shape.map, Image(width, height, Vec3f(std::nanf("")))};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const SphereTexel texel = sphereTexel(shape.map, width, height, x, y);
            if (texel.solidAngle > 0.0) environment.radiance.at(x, y) = radiance(texel.direction);
        }
    }
    return environment;
}

/// ∫ L dω, with texels normalised to cover the sphere.
inline Vec3d integrate(const Environment& environment) {
    const Image& image = environment.radiance;
    Vec3d sum(0.0);
    double solidAngle = 0.0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const SphereTexel texel = sphereTexel(environment.map, image.width, image.height, x, y);
            if (texel.solidAngle == 0.0) continue;
            solidAngle += texel.solidAngle;
            sum += Vec3d(image.at(x, y)) * texel.solidAngle;
        }
    }
    return sum * (4.0 * std::numbers::pi / solidAngle);
}

/// NaN where any of them is.
inline double maxDifference(const Lighting& a, const Lighting& b) {
    double difference = 0.0;
    for (std::size_t i = 0; i < a.coefficients.size(); ++i) {
        const double length = (a.coefficients[i] - b.coefficients[i]).length();
        if (std::isnan(length)) return length;
        difference = std::max(difference, length);
    }
    return difference;
}

}  // namespace prt::test
