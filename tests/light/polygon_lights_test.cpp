#include "prt/light/polygon_lights.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "prt/base/random.h"
#include "prt/light/analytic_lights.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-12;

void expectNear(const Lighting& lighting, const Lighting& truth, double tolerance) {
    ASSERT_EQ(lighting.coefficients.size(), truth.coefficients.size());
    for (std::size_t i = 0; i < truth.coefficients.size(); ++i)
        EXPECT_NEAR((lighting.coefficients[i] - truth.coefficients[i]).length(), 0.0, tolerance)
            << i;
}

/// A triangle by quadrature: dω = |N·p| / |p|³ over its plane, in the barycentric coordinates of
/// Duffy, (u, (1 − u) v).
Lighting integrateTriangle(const std::array<Vec3d, 3>& corners, int bandCount) {
    const Vec3d a = corners[1] - corners[0], b = corners[2] - corners[0];
    const double height = std::abs(a.cross(b).dot(corners[0]));
    const auto rule = gaussLegendre(80);
    Lighting lighting(bandCount);
    std::vector<double> values(lighting.coefficients.size());
    for (const QuadratureNode& first : rule)
        for (const QuadratureNode& second : rule) {
            const double u = 0.5 * (1.0 + first.position), v = 0.5 * (1.0 + second.position);
            const Vec3d place = corners[0] + a * u + b * ((1.0 - u) * v);
            const double distance = place.length();
            evaluateSh(place / distance, bandCount, values);
            const double weight = 0.25 * first.weight * second.weight * (1.0 - u) * height /
                                  (distance * distance * distance);
            for (std::size_t i = 0; i < values.size(); ++i)
                lighting.coefficients[i] += Vec3d(weight * values[i]);
        }
    return lighting;
}

Vec3d drawPoint(RandomStream& random) {
    return {2.0 * random.nextUnitDouble() - 1.0, 2.0 * random.nextUnitDouble() - 1.0,
            2.0 * random.nextUnitDouble() - 1.0};
}

TEST(PolygonLighting, IsTheIntegralOverTriangles) {
    constexpr double kQuadrature = 1e-9;
    RandomStream random(7, 0);
    for (int k = 0; k < 20; ++k) {
        // In front of the receiver, not through it.
        const Vec3d offset = drawPoint(random).normalized() * 2.5;
        const std::array<Vec3d, 3> corners = {
            offset + drawPoint(random), offset + drawPoint(random), offset + drawPoint(random)};
        expectNear(polygonLighting(corners, Vec3d(1.0), 10), integrateTriangle(corners, 10),
                   kQuadrature);
    }
}

// Half of the sphere, x > 0, and a quarter, x > 0 and y > 0, are channels of DirectXMath's test
// function: the half in closed form, the quarter as summed over its texels.
TEST(PolygonLighting, AHalfAndAQuarterOfTheSphereHaveThePublishedCoefficients) {
    constexpr double kPrinted = 1e-6, kSummed = 1e-4;
    std::array<double, 36> half{};
    half[0] = 1.772454;
    half[static_cast<std::size_t>(shIndex(1, 1))] = -1.534990;
    half[static_cast<std::size_t>(shIndex(3, 1))] = -0.358963;
    half[static_cast<std::size_t>(shIndex(3, 3))] = 0.463419;
    half[static_cast<std::size_t>(shIndex(5, 1))] = -0.177872;
    half[static_cast<std::size_t>(shIndex(5, 3))] = 0.192123;
    half[static_cast<std::size_t>(shIndex(5, 5))] = -0.257761;
    const std::array<double, 36> quarter = {
        0.886227,  -0.767507, 0,         -0.767507, 0.728366,  0, 0,        0,         0,
        -0.231710, 0,         -0.179526, 0,         -0.179526, 0, 0.231710, 0,         0,
        0.252313,  0,         0,         0,         0,         0, 0,        -0.128880, 0,
        -0.096062, 0,         -0.089024, 0,         -0.089024, 0, 0.096062, 0,         -0.128880};
    const Vec3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    const Lighting halfLighting = polygonLighting(std::array{y, z, -y, -z}, Vec3d(1.0), 6);
    const Lighting quarterLighting = polygonLighting(std::array{z, x, -z, y}, Vec3d(1.0), 6);
    for (std::size_t i = 0; i < 36; ++i) {
        EXPECT_NEAR(halfLighting.coefficients[i].x, half[i], kPrinted) << i;
        EXPECT_NEAR(quarterLighting.coefficients[i].x, quarter[i], kSummed) << i;
    }
}

TEST(PolygonLighting, ManyCornersOnACircleAreADisc) {
    constexpr int kCornerCount = 2000;
    constexpr double kInscribed = 2e-5;  // an inscribed polygon lacks 2π²/3N² of the area
    const double halfAngle = 0.5;
    std::vector<Vec3d> corners;
    for (int k = 0; k < kCornerCount; ++k) {
        const double angle = 2.0 * kPi * k / kCornerCount;
        corners.emplace_back(std::sin(halfAngle) * std::cos(angle), std::cos(halfAngle),
                             std::sin(halfAngle) * std::sin(angle));
    }
    expectNear(polygonLighting(corners, Vec3d(1.0), 8),
               discLighting(Vec3d(0, 1, 0), halfAngle, Vec3d(1.0), 8), kInscribed);
}

TEST(PolygonLighting, PartsAddUpEvenWhereThePolygonIsNotConvex) {
    const Vec3d a(-1, -1, 2), b(1, -1, 2), c(1, 1, 2), d(0.1, -0.7, 2);
    const std::array<Vec3d, 4> arrow = {a, b, c, d};
    const std::array<Vec3d, 3> first = {a, b, d}, second = {b, c, d};
    expectNear(polygonLighting(arrow, Vec3d(1.0), 6),
               add(polygonLighting(first, Vec3d(1.0), 6), polygonLighting(second, Vec3d(1.0), 6)),
               kRounding);
}

TEST(PolygonLighting, BothSidesShineAlike) {
    const std::array<Vec3d, 3> corners = {Vec3d(1, 0, 2), Vec3d(0, 1, 2), Vec3d(-1, -1, 3)};
    const std::array<Vec3d, 3> turned = {corners[2], corners[1], corners[0]};
    const Vec3d radiance(1.0, 2.0, 3.0);
    expectNear(polygonLighting(corners, radiance, 5), polygonLighting(turned, radiance, 5),
               kRounding);
}

TEST(PolygonLighting, SeenFromItsPlaneIsDark) {
    const std::array<Vec3d, 3> corners = {Vec3d(1, 0, 0), Vec3d(2, 1, 0), Vec3d(2, -1, 0)};
    expectNear(polygonLighting(corners, Vec3d(1.0), 5), Lighting(5), kRounding);
}

TEST(PolygonLighting, FarAwayIsADirectionalLight) {
    const double distance = 1e3;
    const std::array<Vec3d, 4> corners = {Vec3d(-.5, -.5, -distance), Vec3d(.5, -.5, -distance),
                                          Vec3d(.5, .5, -distance), Vec3d(-.5, .5, -distance)};
    const double solidAngle = 1.0 / (distance * distance);
    expectNear(polygonLighting(corners, Vec3d(1.0 / solidAngle), 5),
               directionalLighting(Vec3d(0, 0, -1), Vec3d(1.0), 5), 1e-5);
}

TEST(ParallelogramLighting, APlainPictureIsAPlainPolygon) {
    const Vec3d corner(-1.0, 0.5, -1.2), right(1.6, 0.3, 0.1), down(0.2, -1.1, 0.4);
    const std::array<Vec3d, 4> corners = {corner, corner + right, corner + right + down,
                                          corner + down};
    const Vec3d radiance(1.0, 0.5, 2.0);
    const Lighting truth = polygonLighting(corners, radiance, 8);
    expectNear(parallelogramLighting(corner, right, down, Image(4, 3, Vec3f(radiance)), 8), truth,
               1e-8);
    expectNear(parallelogramLighting(corner, right, down, Image(1, 1, Vec3f(radiance)), 8), truth,
               1e-6);
}

TEST(ParallelogramLighting, TexelsAreThePolygonsTheyCover) {
    constexpr double kQuadrature = 1e-5;
    const Vec3d corner(-1.0, 1.0, -2.0), right(2.0, 0.0, 0.0), down(0.0, -2.0, 0.0);
    Image picture(3, 2);
    RandomStream random(3, 0);
    Lighting truth(6);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) {
            picture.at(x, y) = Vec3f(random.nextUnitFloat(), random.nextUnitFloat(), 1.0f);
            const Vec3d start = corner + right * (x / 3.0) + down * (y / 2.0);
            const std::array<Vec3d, 4> texel = {
                start, start + right / 3.0, start + right / 3.0 + down / 2.0, start + down / 2.0};
            truth = add(truth, polygonLighting(texel, Vec3d(picture.at(x, y)), 6));
        }
    expectNear(parallelogramLighting(corner, right, down, picture, 6), truth, kQuadrature);
}

}  // namespace
}  // namespace prt
