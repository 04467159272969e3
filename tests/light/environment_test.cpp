#include "prt/light/environment.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "drawn_environment.h"
#include "prt/base/random.h"
#include "prt/light/analytic_lights.h"

namespace prt {
namespace {

using test::draw;
using test::kShapes;
using test::maxDifference;
using test::Shape;

constexpr double kPi = std::numbers::pi;

// T-31
TEST(ProjectLighting, AConstantEnvironmentHasItsMeanAndNothingElse) {
    constexpr double kRounding = 1e-12;
    for (const Shape& shape : kShapes) {
        for (const int cellSize : {8, 32}) {
            const Lighting lighting = projectLighting(
                draw(shape, cellSize, [](const Vec3d&) { return Vec3f(1, 2, 0.5f); }), 5);
            const Vec3d mean = Vec3d(1, 2, 0.5) * (2.0 * std::sqrt(kPi));
            EXPECT_NEAR((lighting.coefficients[0] - mean).length(), 0.0, kRounding);
            // Texels of the other maps count at their centre, which
            // leaves the square of their size.
            const double rest =
                shape.map == SphereMap::latLong ? kRounding : 24.0 / (cellSize * cellSize);
            for (std::size_t i = 1; i < 25; ++i) {
                EXPECT_NEAR(lighting.coefficients[i].length(), 0.0, rest)
                    << sphereMapName(shape.map) << " of " << cellSize << ", coefficient " << i;
            }
        }
    }
}

// T-10: the probe of DirectXMath's own tests, red where x > 0, green where y > 0, blue where both
// are, with its coefficients in closed form. Symmetric in z, it reads the same in left- and
// right-handed axes.
TEST(ProjectLighting, TheAnalyticProbeHasThePublishedCoefficients) {
    constexpr double kPrintedPrecision = 1e-6;
    constexpr double kPublishedError = 1e-4;  // the blue table is not closed, but a fine quadrature
    const auto isPositive = [](double coordinate) { return coordinate > 0.0 ? 1.0f : 0.0f; };
    const auto probe = draw(kShapes[0], 32, [&](const Vec3d& d) {
        return Vec3f(isPositive(d.x), isPositive(d.y), isPositive(d.x) * isPositive(d.y));
    });
    const Lighting lighting = projectLighting(probe, 6);

    std::array<double, 36> red{};
    for (const auto& [index, value] : {std::pair(0, 1.772454),
                                       {3, -1.534990},
                                       {13, -.358963},
                                       {15, .463419},
                                       {31, -.177872},
                                       {33, .192123},
                                       {35, -.257761}}) {
        red[static_cast<std::size_t>(index)] = value;
    }
    const std::array<double, 36> blue = {
        0.886227,  -0.767507, 0,         -0.767507, 0.728366,  0, 0,        0,         0,
        -0.231710, 0,         -0.179526, 0,         -0.179526, 0, 0.231710, 0,         0,
        0.252313,  0,         0,         0,         0,         0, 0,        -0.128880, 0,
        -0.096062, 0,         -0.089024, 0,         -0.089024, 0, 0.096062, 0,         -0.128880};
    for (std::size_t i = 0; i < 36; ++i) {
        EXPECT_NEAR(lighting.coefficients[i].x, red[i], kPrintedPrecision) << "red " << i;
        EXPECT_NEAR(lighting.coefficients[i].z, blue[i], kPublishedError) << "blue " << i;
    }
    EXPECT_NEAR(lighting.coefficients[1].y, -1.534990, kPrintedPrecision);
    EXPECT_NEAR(lighting.coefficients[1].z, -1.534990 / 2.0, kPrintedPrecision);
    EXPECT_NEAR(lighting.coefficients[3].y, 0.0, kPrintedPrecision);
}

// T-10, where the published probe is blind: light from one side of each axis alone.
TEST(ProjectLighting, LightFromOneSideHasALinearPartTowardsIt) {
    const Vec3d axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (const Shape& shape : kShapes) {
        for (const Vec3d& axis : axes) {
            const auto half = draw(
                shape, 32, [&](const Vec3d& d) { return Vec3f(d.dot(axis) > 0.0 ? 1.0f : 0.0f); });
            const Lighting lighting = projectLighting(half, 2);
            const Vec3d linear(-lighting.coefficients[3].x, -lighting.coefficients[1].x,
                               lighting.coefficients[2].x);
            EXPECT_NEAR((linear - axis * 1.534990062).length(), 0.0, 0.02)
                << sphereMapName(shape.map);
        }
    }
}

// The six-colour cube, painted cell by cell without our own directions.
TEST(ProjectLighting, EachFaceOfACubeLightsItsOwnSide) {
    const Vec3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    const struct {
        Shape shape;
        std::vector<std::pair<int, Vec3d>> cells;
    } cubes[] = {{kShapes[2], {{1, y}, {3, -x}, {4, -z}, {5, x}, {7, -y}, {10, z}}},
                 {kShapes[3], {{1, y}, {4, -x}, {5, -z}, {6, x}, {7, z}, {9, -y}}},
                 {kShapes[4], {{0, x}, {1, -x}, {2, y}, {3, -y}, {4, z}, {5, -z}}},
                 {kShapes[5], {{0, x}, {1, -x}, {2, y}, {3, -y}, {4, z}, {5, -z}}}};
    constexpr int kFaceSize = 8;
    for (const auto& [shape, cells] : cubes) {
        for (const auto& [cell, axis] : cells) {
            Environment environment{
                shape.map, Image(shape.columnCount * kFaceSize, shape.rowCount * kFaceSize)};
            for (int row = 0; row < kFaceSize; ++row) {
                for (int column = 0; column < kFaceSize; ++column) {
                    environment.radiance.at(cell % shape.columnCount * kFaceSize + column,
                                            cell / shape.columnCount * kFaceSize + row) =
                        Vec3f(1.0f);
                }
            }
            const Lighting lighting = projectLighting(environment, 2);
            const Vec3d linear(-lighting.coefficients[3].x, -lighting.coefficients[1].x,
                               lighting.coefficients[2].x);
            EXPECT_NEAR((linear.normalized() - axis).length(), 0.0, 1e-12)
                << sphereMapName(shape.map) << " " << cell;
            // A sixth of the sphere.
            EXPECT_NEAR(lighting.coefficients[0].x, 2.0 * std::sqrt(kPi) / 6.0, 1e-12);
        }
    }
}

Lighting makeRandomLighting(int bandCount) {
    RandomStream random(9, 0);
    Lighting lighting(bandCount);
    for (Vec3d& coefficient : lighting.coefficients) {
        for (int channel = 0; channel < 3; ++channel)
            coefficient[channel] = random.nextUnitDouble() - 0.5;
    }
    return lighting;
}

TEST(ProjectLighting, ABandLimitedEnvironmentGivesItsCoefficientsThroughEveryMap) {
    const Lighting truth = makeRandomLighting(5);
    for (const Shape& shape : kShapes) {
        const auto errorOf = [&](int cellSize) {
            const auto environment =
                draw(shape, cellSize, [&](const Vec3d& d) { return Vec3f(reconstruct(truth, d)); });
            return maxDifference(projectLighting(environment, 5), truth);
        };
        EXPECT_LT(errorOf(64), 5e-3) << sphereMapName(shape.map);
        EXPECT_LT(errorOf(64), 0.4 * errorOf(32)) << sphereMapName(shape.map);
    }
}

TEST(ProjectLighting, KeepsRadianceAboveOne) {
    const auto bright = draw(kShapes[0], 8, [](const Vec3d&) { return Vec3f(1e6f); });
    EXPECT_NEAR(projectLighting(bright, 1).coefficients[0].x / (1e6 * 2.0 * std::sqrt(kPi)), 1.0,
                1e-12);
}

TEST(ProjectLighting, WorksForThirtyTwoBands) {
    // A texel of 1/40 rad averages the shortest wave, of 31 periods, to 1 − (31/40)²/24 of itself.
    constexpr double kAveraging = 0.03;
    const Lighting truth = makeRandomLighting(32);
    const auto environment =
        draw(kShapes[0], 128, [&](const Vec3d& d) { return Vec3f(reconstruct(truth, d)); });
    EXPECT_LT(maxDifference(projectLighting(environment, 32), truth), kAveraging);
}

TEST(AddDisc, IsTheDiscOfTheClosedFormInEveryMap) {
    constexpr double kTexels = 7e-3;  // of the flux: texels of 2° to 4°
    const Vec3d direction = Vec3d(1.0, 2.0, -2.0) / 3.0;
    for (const SphereMap map : {SphereMap::latLong, SphereMap::angularMap, SphereMap::verticalCross,
                                SphereMap::horizontalStrip, SphereMap::octahedral}) {
        const auto [width, height] =
            sphereMapSize(map, map == SphereMap::horizontalStrip ? 48 : 96);
        for (const double halfAngle : {0.05, 0.7, 2.0, std::numbers::pi}) {
            const double solidAngle = 2.0 * std::numbers::pi * (1.0 - std::cos(halfAngle));
            Environment environment{map, Image(width, height)};
            addDisc(environment, direction, halfAngle, Vec3d(1.0, 2.0, 4.0));
            const Lighting drawn = projectLighting(environment, 5);
            const Lighting truth =
                discLighting(direction, halfAngle, Vec3d(1.0, 2.0, 4.0) / solidAngle, 5);
            for (std::size_t i = 0; i < 25; ++i)
                EXPECT_NEAR((drawn.coefficients[i] - truth.coefficients[i]).length(), 0.0,
                            kTexels * 4.0)
                    << sphereMapName(map) << " " << halfAngle << " " << i;
        }
    }
}

TEST(AddDisc, ALightOfNoExtentIsOneTexelWithAllItsFlux) {
    Environment environment{SphereMap::latLong, Image(16, 8)};
    addDisc(environment, Vec3d(0.0, 1.0, 0.0), 0.0, Vec3d(3.0));
    int litCount = 0;
    double flux = 0.0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) {
            const float radiance = environment.radiance.at(x, y).x;
            litCount += radiance > 0.0f ? 1 : 0;
            flux += static_cast<double>(radiance) *
                    sphereTexel(SphereMap::latLong, 16, 8, x, y).solidAngle;
        }
    EXPECT_EQ(litCount, 1);
    EXPECT_NEAR(flux, 3.0, 1e-6);
}

TEST(ReconstructLatLong, DrawsWhatTheCoefficientsStandFor) {
    const Lighting truth = makeRandomLighting(3);
    const Image image = reconstructLatLong(truth, 64);
    ASSERT_EQ(image.height, 32);
    const SphereTexel texel = sphereTexel(SphereMap::latLong, 64, 32, 50, 7);
    EXPECT_NEAR((Vec3d(image.at(50, 7)) - reconstruct(truth, texel.direction)).length(), 0.0, 1e-6);
    EXPECT_LT(maxDifference(projectLighting({SphereMap::latLong, image}, 3), truth), 5e-3);
}

TEST(LookUpRadiance, IsExactAtTexelCentresAndForConstants) {
    for (const Shape& shape : kShapes) {
        const Vec3f constant(1.0f, 2.0f, 3.0f);
        const auto flat = draw(shape, 16, [&](const Vec3d&) { return constant; });
        const auto sloped = draw(shape, 16, [](const Vec3d& d) { return Vec3f(d); });
        for (int y = 0; y < flat.radiance.height; ++y) {
            for (int x = 0; x < flat.radiance.width; ++x) {
                const SphereTexel texel =
                    sphereTexel(shape.map, flat.radiance.width, flat.radiance.height, x, y);
                if (texel.solidAngle == 0.0) continue;
                EXPECT_NEAR((lookUpRadiance(flat, Vec3f(texel.direction)) - constant).length(),
                            0.0f, 1e-5f);
                if (shape.map == SphereMap::angularMap) continue;  // whose rim is pulled in
                EXPECT_NEAR(
                    (lookUpRadiance(sloped, Vec3f(texel.direction)) - Vec3f(texel.direction))
                        .length(),
                    0.0f, 1e-4f);
            }
        }
        for (const Vec3f& axis : {Vec3f(1, 0, 0), Vec3f(-1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, -1, 0),
                                  Vec3f(0, 0, 1), Vec3f(0, 0, -1), Vec3f(1, 1, 1).normalized()}) {
            EXPECT_NEAR((lookUpRadiance(flat, axis) - constant).length(), 0.0f, 1e-5f)
                << sphereMapName(shape.map);
            EXPECT_NEAR((lookUpRadiance(sloped, axis) - axis).length(), 0.0f, 0.35f)
                << sphereMapName(shape.map);
        }
    }
}

TEST(Sanitise, MakesEveryTexelFiniteAndNonNegative) {
    const float infinity = std::numeric_limits<float>::infinity(), nan = std::nanf("");
    Image image(2, 2);
    image.pixels = {Vec3f(1.0f, nan, 2.0f), Vec3f(infinity, 5.0f, -1.0f),
                    Vec3f(-infinity, 0.0f, 3.0f), Vec3f(0.5f, 0.25f, 0.0f)};
    const SanitiseReport report = sanitise(image);
    EXPECT_EQ(report.nanCount, 1u);
    EXPECT_EQ(report.infiniteCount, 1u);
    EXPECT_EQ(report.negativeCount, 2u);
    EXPECT_EQ(image.pixels[0], Vec3f(1.0f, 0.0f, 2.0f));
    EXPECT_EQ(image.pixels[1], Vec3f(5.0f, 5.0f, 0.0f));
    EXPECT_EQ(image.pixels[2], Vec3f(0.0f, 0.0f, 3.0f));
    EXPECT_EQ(image.pixels[3], Vec3f(0.5f, 0.25f, 0.0f));
}

TEST(Sanitise, AnImageWithoutFiniteLightBecomesBlack) {
    Image image(1, 1, Vec3f(std::numeric_limits<float>::infinity()));
    EXPECT_EQ(sanitise(image).infiniteCount, 1u);
    EXPECT_EQ(image.pixels[0], Vec3f(0.0f));
}

}  // namespace
}  // namespace prt
