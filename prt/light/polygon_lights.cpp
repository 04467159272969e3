// Bibliography
//   [Wang18]        Analytic spherical harmonic coefficients for polygonal area lights
//   [VanOosterom83] The solid angle of a plane triangle
#include "prt/light/polygon_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "prt/base/assert.h"
#include "prt/basis/sh_rotation.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

/// The solid angle of a triangle of unit directions, positive if they turn to the left as seen from
/// outside the sphere [VanOosterom83].
double signedSolidAngle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return 2.0 * std::atan2(a.dot(b.cross(c)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
}

/// The sum of the triangles between the edges and a direction in their midst.
double signedSolidAngle(std::span<const Vec3d> directions) {
    Vec3d middle(0.0);
    for (const Vec3d& direction : directions)
        middle += direction;
    if (middle.length() < 1e-6) middle = directions[0].cross(directions[1]);
    middle.normalize();
    double sum = 0.0;
    for (std::size_t k = 0; k < directions.size(); ++k)
        sum += signedSolidAngle(middle, directions[k], directions[(k + 1) % directions.size()]);
    return sum;
}

/// ∫ N·∇y_lm ds along an arc of the equator from +x, N being +z.
///
/// There ∂y_lm/∂z = √((2l+1)(l² − m²)/(2l−1)) y_{l−1,m}, and y_{l−1,±m} goes as cos and sin of mφ.
std::vector<double> integrateAlongEquator(double arcRadians, int bandCount) {
    const auto count = static_cast<std::size_t>(shCoefficientCount(bandCount));
    std::vector<double> integrals(count, 0.0), atStart(count);
    evaluateSh(Vec3d(1.0, 0.0, 0.0), bandCount, atStart);
    for (int l = 1; l < bandCount; ++l) {
        for (int m = 0; m < l; ++m) {
            const double slope = std::sqrt((2.0 * l + 1.0) * (l - m) * (l + m) / (2.0 * l - 1.0)) *
                                 atStart[static_cast<std::size_t>(shIndex(l - 1, m))];
            const double half = std::sin(0.5 * m * arcRadians);
            const double cosine = m > 0 ? std::sin(m * arcRadians) / m : arcRadians;
            integrals[static_cast<std::size_t>(shIndex(l, m))] = slope * cosine;
            if (m > 0)
                integrals[static_cast<std::size_t>(shIndex(l, -m))] = slope * 2.0 * half * half / m;
        }
    }
    return integrals;
}

/// Adds ∫ N·∇y_lm ds along the great arc between two directions.
void addEdge(const Vec3d& from, const Vec3d& to, int bandCount, std::span<double> sums) {
    const Vec3d cross = from.cross(to);
    const double sine = cross.length(), cosine = from.dot(to);
    if (sine == 0.0 && cosine > 0.0) return;  // two corners in one direction
    PRT_ASSERT(sine > 0.0, "no edge passes through the receiver");
    const Vec3d pole = cross / sine, side = pole.cross(from);
    const Mat3d worldFromEdge(from.x, side.x, pole.x, from.y, side.y, pole.y, from.z, side.z,
                              pole.z);
    const auto aboutPole = integrateAlongEquator(std::atan2(sine, cosine), bandCount);
    std::vector<double> turned(aboutPole.size());
    ShRotation(worldFromEdge, bandCount).apply(aboutPole, turned);
    for (std::size_t i = 0; i < turned.size(); ++i)
        sums[i] += turned[i];
}

/// Into how many strips a parallelogram is cut each way, so that no basis function turns by more
/// than a radian over a part.
int chooseStripCount(const Vec3d& corner, const Vec3d& right, const Vec3d& down, int bandCount) {
    constexpr int kMaxStripCount = 64;  // in its own plane a parallelogram is nearly dark
    const Vec3d normal = right.cross(down);
    const double diameter = std::max((right + down).length(), (right - down).length());
    const double distance =
        std::max((corner + (right + down) * 0.5).length() - 0.5 * diameter,
                 std::abs(normal.dot(corner)) / std::max(normal.length(), 1e-300));
    const double strips = std::ceil(bandCount * diameter / std::max(distance, 1e-300));
    return static_cast<int>(std::clamp(strips, 1.0, double(kMaxStripCount)));
}

/// Adds ∫ y_i dω over a parallelogram, where dω = |N·p| / |p|³ du dv and N·p, N = right × down, is
/// the same all over.
void integrateParallelogram(const Vec3d& corner, const Vec3d& right, const Vec3d& down,
                            int bandCount, std::span<double> sums) {
    static const std::vector<QuadratureNode> kRule = gaussLegendre(4);
    const int stripCount = chooseStripCount(corner, right, down, bandCount);
    const double height = std::abs(right.cross(down).dot(corner)) / (stripCount * stripCount);
    std::vector<double> values(sums.size());
    for (int part = 0; part < stripCount * stripCount; ++part) {
        for (const QuadratureNode& row : kRule) {
            for (const QuadratureNode& column : kRule) {
                const double u = part % stripCount + 0.5 * (1.0 + column.position);
                const double v = part / stripCount + 0.5 * (1.0 + row.position);
                const Vec3d place = corner + (right * u + down * v) / stripCount;
                const double distance = place.length();
                const double solidAngle =
                    0.25 * row.weight * column.weight * height / (distance * distance * distance);
                evaluateSh(place / distance, bandCount, values);
                for (std::size_t i = 0; i < values.size(); ++i)
                    sums[i] += solidAngle * values[i];
            }
        }
    }
}

}  // namespace

Lighting polygonLighting(std::span<const Vec3d> corners, const Vec3d& radiance, int bandCount) {
    PRT_ASSERT(corners.size() >= 3, "a polygon has at least three corners");
    std::vector<Vec3d> directions;
    for (const Vec3d& corner : corners) {
        PRT_ASSERT(corner.length() > 0.0, "no corner is at the receiver");
        directions.push_back(corner.normalized());
    }
    Lighting lighting(bandCount);
    std::vector<double> sums(lighting.coefficients.size(), 0.0);
    for (std::size_t k = 0; k < directions.size(); ++k)
        addEdge(directions[k], directions[(k + 1) % directions.size()], bandCount, sums);

    const double solidAngle = signedSolidAngle(directions);
    const double side = solidAngle < 0.0 ? -1.0 : 1.0;
    lighting.coefficients[0] = radiance * (std::abs(solidAngle) * 0.5 * std::numbers::inv_sqrtpi);
    for (std::size_t i = 1; i < sums.size(); ++i) {
        const int l = shDegree(static_cast<int>(i));
        lighting.coefficients[i] = radiance * (side * sums[i] / (l * (l + 1.0)));
    }
    return lighting;
}

Lighting parallelogramLighting(const Vec3d& corner, const Vec3d& right, const Vec3d& down,
                               const Image& radiance, int bandCount) {
    PRT_ASSERT(!radiance.pixels.empty(), "the picture has texels");
    const Vec3d texelRight = right / radiance.width, texelDown = down / radiance.height;
    Lighting lighting(bandCount);
    std::vector<double> sums(lighting.coefficients.size());
    for (int y = 0; y < radiance.height; ++y) {
        for (int x = 0; x < radiance.width; ++x) {
            std::fill(sums.begin(), sums.end(), 0.0);
            const Vec3d texelCorner = corner + texelRight * x + texelDown * y;
            integrateParallelogram(texelCorner, texelRight, texelDown, bandCount, sums);
            const Vec3d texel(radiance.at(x, y));
            for (std::size_t i = 0; i < sums.size(); ++i)
                lighting.coefficients[i] += texel * sums[i];
        }
    }
    return lighting;
}

}  // namespace prt
