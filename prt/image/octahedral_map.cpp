// Bibliography
//   [Engelhardt08]    Octahedron environment maps
//   [Cigolle14]       A survey of efficient representations for independent unit vectors
//   [VanOosterom83]   The solid angle of a plane triangle
#include "prt/image/octahedral_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace prt {
namespace {

/// A place of the square [−1, 1]², u right and v down; the upper half is |u| + |v| ≤ 1.
struct SquarePlace {
    double u = 0.0;
    double v = 0.0;
};

double squareCoordinate(double pixel, int size) {
    return 2.0 * pixel / size - 1.0;
}

/// How far above the octahedron's equator a place of its upper half lies.
double heightAt(const SquarePlace& place) {
    return 1.0 - std::abs(place.u) - std::abs(place.v);
}

/// The place straight below or above on the octahedron: a mirror image in the edge between.
SquarePlace mirror(const SquarePlace& place) {
    return {std::copysign(1.0 - std::abs(place.v), place.u),
            std::copysign(1.0 - std::abs(place.u), place.v)};
}

/// A point of the octahedron, not of the sphere.
Vec3d octahedronPoint(const SquarePlace& place) {
    const double height = heightAt(place);
    const SquarePlace shown = height < 0.0 ? mirror(place) : place;
    return {shown.u, height, -shown.v};
}

/// The solid angle of a triangle in the quadrant u, v ≥ 0 of the upper half [VanOosterom83, eq. 8],
/// where the triple product of its corners is twice its area in the square.
double triangleSolidAngle(const SquarePlace& first, const SquarePlace& second,
                          const SquarePlace& third) {
    const double tripleProduct =
        (second.u - first.u) * (third.v - first.v) - (third.u - first.u) * (second.v - first.v);
    const Vec3d a = octahedronPoint(first), b = octahedronPoint(second), c = octahedronPoint(third);
    const double lengthA = a.length(), lengthB = b.length(), lengthC = c.length();
    return 2.0 *
           std::atan2(std::abs(tripleProduct), lengthA * lengthB * lengthC + a.dot(b) * lengthC +
                                                   b.dot(c) * lengthA + c.dot(a) * lengthB);
}

/// The solid angle of the part of a rectangle in u, v ≥ 0 that the upper half shows.
double upperSolidAngle(const SquarePlace& low, const SquarePlace& high) {
    const SquarePlace corners[] = {low, {high.u, low.v}, high, {low.u, high.v}};
    std::vector<SquarePlace> shown;
    for (int i = 0; i < 4; ++i) {
        const SquarePlace &from = corners[i], &to = corners[(i + 1) % 4];
        const double fromHeight = heightAt(from), toHeight = heightAt(to);
        if (fromHeight >= 0.0) shown.push_back(from);
        if ((fromHeight < 0.0) == (toHeight < 0.0)) continue;
        const double t = fromHeight / (fromHeight - toHeight);
        shown.push_back({from.u + t * (to.u - from.u), from.v + t * (to.v - from.v)});
    }
    double sum = 0.0;
    for (std::size_t i = 2; i < shown.size(); ++i)
        sum += triangleSolidAngle(shown[0], shown[i - 1], shown[i]);
    return sum;
}

/// The parts of a texel's extent on one axis, by distance from the middle of the square.
struct Extent {
    double low;
    double high;
    double count;  // the texel in the middle of an odd size lies on both sides
};

Extent extentOf(int pixel, int size) {
    const double from = squareCoordinate(pixel, size), to = squareCoordinate(pixel + 1, size);
    if (2 * pixel + 1 == size) return {0.0, to, 2.0};
    return {std::min(std::abs(from), std::abs(to)), std::max(std::abs(from), std::abs(to)), 1.0};
}

}  // namespace

SphereTexel octahedralTexel(int size, int x, int y) {
    const Extent u = extentOf(x, size), v = extentOf(y, size);
    const double solidAngle =
        upperSolidAngle({u.low, v.low}, {u.high, v.high}) +
        upperSolidAngle({1.0 - v.high, 1.0 - u.high}, {1.0 - v.low, 1.0 - u.low});
    return {octahedralPlace(size, x + 0.5, y + 0.5).direction, u.count * v.count * solidAngle};
}

SpherePlace octahedralPlace(int size, double x, double y) {
    const Vec3d point = octahedronPoint({squareCoordinate(x, size), squareCoordinate(y, size)});
    const double distance = point.length();
    const double pixelSide = 2.0 / size;
    return {point / distance, pixelSide * pixelSide / (distance * distance * distance)};
}

Vec2f octahedralPixel(int size, const Vec3f& direction) {
    const Vec3d d(direction);
    const double scale = 1.0 / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
    SquarePlace place{scale * d.x, -scale * d.z};
    if (d.y < 0.0) place = mirror(place);
    return Vec2f(static_cast<float>(0.5 * size * (1.0 + place.u)),
                 static_cast<float>(0.5 * size * (1.0 + place.v)));
}

TexelIndex wrapOctahedral(int size, int x, int y) {
    if (x < 0 || x >= size) {
        x = x < 0 ? 0 : size - 1;
        y = size - 1 - y;
    }
    if (y < 0 || y >= size) {
        y = y < 0 ? 0 : size - 1;
        x = size - 1 - x;
    }
    return {x, y};
}

}  // namespace prt
