#include "prt/light/resampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "drawn_environment.h"
#include "prt/base/random.h"
#include "prt/basis/zonal.h"

namespace prt {
namespace {

using test::draw;
using test::integrate;
using test::kShapes;
using test::maxDifference;
using test::Shape;

/// A cell size under which the image has about so many texels that show something.
int cellSizeFor(const Shape& shape, double texelCount) {
    const bool isCube = shape.columnCount * shape.rowCount > 2;
    const double cellCount = isCube ? 6.0 : shape.columnCount * shape.rowCount;
    return static_cast<int>(std::lround(std::sqrt(texelCount / cellCount)));
}

Environment resampleTo(const Environment& source, const Shape& shape, int cellSize) {
    return resample(source, shape.map, shape.columnCount * cellSize, shape.rowCount * cellSize);
}

/// Some smooth light that is nowhere negative.
Lighting makeSmoothLighting() {
    Lighting lighting(3);
    RandomStream random(21, 0);
    for (Vec3d& coefficient : lighting.coefficients)
        for (int channel = 0; channel < 3; ++channel)
            coefficient[channel] = 0.6 * (random.nextUnitDouble() - 0.5);
    lighting.coefficients[0] = Vec3d(5.0);
    return lighting;
}

double largestError(const Environment& environment, const Lighting& truth) {
    const Image& image = environment.radiance;
    double error = 0.0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const SphereTexel texel = sphereTexel(environment.map, image.width, image.height, x, y);
            if (texel.solidAngle > 0.0)
                error = std::max(
                    error, (Vec3d(image.at(x, y)) - reconstruct(truth, texel.direction)).length());
        }
    return error;
}

TEST(Resample, KeepsSmoothLightThroughEveryPairOfLayouts) {
    // Both sizes have texels of some 3°, over which light of three bands varies by a few
    // hundredths.
    constexpr double kTexelVariation = 0.04;
    constexpr double kCoefficientError = 0.005;
    const Lighting truth = makeSmoothLighting();
    for (const Shape& from : kShapes) {
        const Environment source = draw(from, cellSizeFor(from, 6000), [&](const Vec3d& d) {
            return Vec3f(reconstruct(truth, d));
        });
        const Lighting sourceLighting = projectLighting(source, 3);
        for (const Shape& to : kShapes) {
            const Environment result = resampleTo(source, to, cellSizeFor(to, 4500));
            EXPECT_LT(largestError(result, truth), kTexelVariation)
                << sphereMapName(from.map) << " to " << sphereMapName(to.map);
            EXPECT_LT(maxDifference(projectLighting(result, 3), sourceLighting), kCoefficientError)
                << sphereMapName(from.map) << " to " << sphereMapName(to.map);
        }
    }
}

TEST(Resample, KeepsAConstantAndShowsNothingWhereTheMapDoesNot) {
    constexpr float kFloatRounding = 1e-5f;
    const Vec3f radiance(1.0f, 2.0f, 0.5f);
    for (const Shape& from : kShapes) {
        const Environment source = draw(from, 12, [&](const Vec3d&) { return radiance; });
        for (const Shape& to : kShapes) {
            for (const int cellSize : {3, 7, 30}) {
                const Environment result = resampleTo(source, to, cellSize);
                const Image& image = result.radiance;
                for (int y = 0; y < image.height; ++y)
                    for (int x = 0; x < image.width; ++x) {
                        const bool isShown =
                            sphereTexel(to.map, image.width, image.height, x, y).solidAngle > 0.0;
                        EXPECT_NEAR((image.at(x, y) - (isShown ? radiance : Vec3f(0.0f))).length(),
                                    0.0f, kFloatRounding)
                            << sphereMapName(from.map) << " to " << sphereMapName(to.map);
                    }
            }
        }
    }
}

// A sun of one texel, wherever it stands: beside poles, seams, rims and edges too.
TEST(Resample, KeepsTheFluxOfASunWhenItShrinks) {
    constexpr double kFloatRounding = 1e-6;  // beside a sky that is the same everywhere
    RandomStream random(22, 0);
    int sunCount = 0;
    for (const Shape& from : kShapes) {
        const int cellSize = cellSizeFor(from, 3000);
        const Environment sky =
            draw(from, cellSize, [](const Vec3d&) { return Vec3f(1.0f, 0.1f, 0.0f); });
        for (const Shape& to : kShapes) {
            for (int i = 0; i < 4; ++i) {
                Environment source = sky;
                Image& image = source.radiance;
                int x = 0, y = i == 0 ? 0 : image.height - 1;
                while (i > 1 ||
                       sphereTexel(from.map, image.width, image.height, x, y).solidAngle == 0.0) {
                    x = static_cast<int>(random.nextUnitDouble() * image.width);
                    y = static_cast<int>(random.nextUnitDouble() * image.height);
                    if (sphereTexel(from.map, image.width, image.height, x, y).solidAngle > 0.0)
                        break;
                }
                image.at(x, y) = Vec3f(1e5f);
                const Vec3d before = integrate(source);
                const Vec3d after =
                    integrate(resampleTo(source, to, cellSizeFor(to, 200 + 150 * i)));
                for (int channel = 0; channel < 3; ++channel)
                    EXPECT_NEAR(after[channel] / before[channel], 1.0, kFloatRounding)
                        << sphereMapName(from.map) << " " << x << ", " << y << " to "
                        << sphereMapName(to.map) << ", channel " << channel;
                ++sunCount;
            }
        }
    }
    EXPECT_EQ(sunCount, 7 * 7 * 4);
}

TEST(Resample, KeepsTheFluxOfManyLights) {
    constexpr double kPromise = 1e-3;
    RandomStream random(25, 0);
    for (const Shape& from : kShapes) {
        const Environment source = draw(from, cellSizeFor(from, 6000), [&](const Vec3d&) {
            const float brightness = random.nextUnitFloat();
            return Vec3f(brightness, brightness > 0.98f ? 100.0f : 1.0f,
                         std::pow(brightness, 8.0f));
        });
        const Vec3d before = integrate(source);
        for (const Shape& to : kShapes) {
            const Vec3d after = integrate(resampleTo(source, to, cellSizeFor(to, 1000)));
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(after[channel] / before[channel], 1.0, kPromise)
                    << sphereMapName(from.map) << " to " << sphereMapName(to.map);
        }
    }
}

TEST(Resample, BlocksOfALatLongMapBecomeTheirMeanOverSolidAngle) {
    constexpr double kFloatRounding = 1e-6;
    constexpr int kBlock = 3, kWidth = 8, kHeight = 4;
    Environment source{SphereMap::latLong, Image(kBlock * kWidth, kBlock * kHeight)};
    RandomStream random(5, 0);
    for (Vec3f& radiance : source.radiance.pixels)
        for (int channel = 0; channel < 3; ++channel)
            radiance[channel] = static_cast<float>(random.nextUnitDouble());
    const Environment result = resample(source, SphereMap::latLong, kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            Vec3d flux(0.0);
            double solidAngle = 0.0;
            for (int i = 0; i < kBlock * kBlock; ++i) {
                const int column = kBlock * x + i % kBlock, row = kBlock * y + i / kBlock;
                const double ofTexel =
                    sphereTexel(SphereMap::latLong, kBlock * kWidth, kBlock * kHeight, column, row)
                        .solidAngle;
                flux += Vec3d(source.radiance.at(column, row)) * ofTexel;
                solidAngle += ofTexel;
            }
            EXPECT_LT((Vec3d(result.radiance.at(x, y)) - flux / solidAngle).length(),
                      kFloatRounding);
        }
}

TEST(Resample, LeavesASunInItsPlace) {
    Environment source = draw(kShapes[0], 64, [](const Vec3d&) { return Vec3f(0.0f); });
    source.radiance.at(40, 20) = Vec3f(1000.0f);
    const Vec3d direction = sphereTexel(SphereMap::latLong, 128, 64, 40, 20).direction;
    for (const Shape& to : kShapes) {
        const int cellSize = cellSizeFor(to, 1000);
        const Environment result = resampleTo(source, to, cellSize);
        const Lighting lighting = projectLighting(result, 2);
        const Vec3d mean(-lighting.coefficients[3].x, -lighting.coefficients[1].x,
                         lighting.coefficients[2].x);
        EXPECT_LT((mean.normalized() - direction).length(), 0.1) << sphereMapName(to.map);
    }
}

TEST(Resample, IsBilinearWhenItEnlarges) {
    // The flux of a texel is kept, which bilinear look-ups alone lose by some hundredths where
    // texels differ in size, and at the clamped edges of cube faces.
    constexpr float kFluxCorrection = 0.08f;
    for (const Shape& shape : kShapes) {
        if (shape.map == SphereMap::angularMap) continue;  // whose rim is pulled in
        RandomStream random(23, 0);
        const Environment source =
            draw(shape, 8, [&](const Vec3d&) { return Vec3f(random.nextUnitFloat()); });
        const Environment result = resampleTo(source, shape, 64);
        const Image& image = result.radiance;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const SphereTexel texel = sphereTexel(shape.map, image.width, image.height, x, y);
                if (texel.solidAngle == 0.0) continue;
                EXPECT_NEAR(image.at(x, y).x, lookUpRadiance(source, Vec3f(texel.direction)).x,
                            kFluxCorrection)
                    << sphereMapName(shape.map) << " " << x << ", " << y;
            }
    }
}

// The six-colour cube, painted cell by cell without our own directions.
TEST(Resample, EachFaceOfACubeKeepsLightingItsOwnSide) {
    constexpr int kFaceSize = 16;
    const Vec3f colors[] = {{1, 0, 0}, {0, 1, 1}, {0, 1, 0}, {1, 0, 1}, {0, 0, 1}, {1, 1, 0}};
    const Vec3d axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    Environment cube{SphereMap::verticalStrip, Image(kFaceSize, 6 * kFaceSize)};
    for (int y = 0; y < 6 * kFaceSize; ++y)
        for (int x = 0; x < kFaceSize; ++x)
            cube.radiance.at(x, y) = colors[y / kFaceSize];
    const std::vector<double> cosine = clampedCosineZonal(3);
    for (const Shape& to : kShapes) {
        const Lighting lighting = projectLighting(resampleTo(cube, to, cellSizeFor(to, 2000)), 3);
        for (int face = 0; face < 6; ++face) {
            std::vector<double> lobe(9);
            rotateZonal(cosine, axes[face], lobe);
            Vec3d irradiance(0.0);
            for (std::size_t i = 0; i < 9; ++i)
                irradiance += lighting.coefficients[i] * lobe[i];
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_EQ(irradiance[channel] > 0.5 * std::numbers::pi,
                          colors[face][channel] > 0.5f)
                    << sphereMapName(to.map) << " face " << face << " channel " << channel;
        }
    }
}

TEST(RotateEnvironment, TurnsAsItsCoefficientsDo) {
    constexpr double kTexelVariation = 0.005;
    const Lighting truth = makeSmoothLighting();
    const Mat3d rotation = rotationX(0.7) * rotationY(2.1) * rotationZ(-0.4);
    for (const Shape& shape : kShapes) {
        const Environment source = draw(shape, cellSizeFor(shape, 6000), [&](const Vec3d& d) {
            return Vec3f(reconstruct(truth, d));
        });
        const Environment turned = rotate(source, rotation);
        EXPECT_EQ(turned.radiance.width, source.radiance.width);
        EXPECT_EQ(turned.map, source.map);
        EXPECT_LT(
            maxDifference(projectLighting(turned, 3), rotate(projectLighting(source, 3), rotation)),
            kTexelVariation)
            << sphereMapName(shape.map);
    }
}

TEST(RotateEnvironment, TheInverseLeadsBack) {
    constexpr double kTexelVariation = 0.03;
    const Lighting truth = makeSmoothLighting();
    const Mat3d rotation = rotationX(0.7) * rotationY(2.1);
    for (const Shape& shape : kShapes) {
        const Environment source = draw(shape, cellSizeFor(shape, 6000), [&](const Vec3d& d) {
            return Vec3f(reconstruct(truth, d));
        });
        EXPECT_LT(largestError(rotate(rotate(source, rotation), rotation.transposed()), truth),
                  kTexelVariation)
            << sphereMapName(shape.map);
    }
}

TEST(RotateEnvironment, NoRotationChangesNothing) {
    RandomStream random(24, 0);
    const Environment source =
        draw(kShapes[0], 16, [&](const Vec3d&) { return Vec3f(random.nextUnitFloat()); });
    EXPECT_EQ(rotate(source, Mat3d()).radiance.pixels, source.radiance.pixels);
}

TEST(ResampleAsLatLong, TexelsAreAsFineAndLightStaysWhereItIs) {
    constexpr double kTexelVariation = 0.005;
    const Lighting truth = makeSmoothLighting();
    for (const Shape& shape : kShapes) {
        const Environment source = draw(shape, cellSizeFor(shape, 6000), [&](const Vec3d& d) {
            return Vec3f(reconstruct(truth, d));
        });
        const Environment drawn = resampleAsLatLong(source);
        EXPECT_EQ(drawn.map, SphereMap::latLong);
        EXPECT_TRUE(shape.map != SphereMap::latLong ||
                    drawn.radiance.pixels == source.radiance.pixels);
        EXPECT_LT(maxDifference(projectLighting(drawn, 3), projectLighting(source, 3)),
                  kTexelVariation)
            << sphereMapName(shape.map);
        const double texelRatio = static_cast<double>(drawn.radiance.pixels.size()) /
                                  static_cast<double>(source.radiance.pixels.size());
        EXPECT_GE(texelRatio, 0.4) << sphereMapName(shape.map);
        EXPECT_LE(texelRatio, 2.5) << sphereMapName(shape.map);
    }
}

}  // namespace
}  // namespace prt
