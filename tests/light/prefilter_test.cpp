#include "prt/light/prefilter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "drawn_environment.h"
#include "prt/base/random.h"
#include "prt/basis/zonal.h"
#include "prt/light/analytic_lights.h"
#include "prt/light/resampling.h"

namespace prt {
namespace {

using test::draw;
using test::integrate;
using test::kShapes;
using test::Shape;

constexpr double kPi = std::numbers::pi;
constexpr int kFaceSize = 16;

/// The lobes as the header defines them, of the cosine of the angle to the mirrored direction.
double lobeAt(ReflectionLobe lobe, double roughness, double cosine) {
    if (cosine <= 0.0) return 0.0;
    const double alpha = roughness * roughness;
    if (lobe == ReflectionLobe::phong) return std::pow(cosine, 1.0 / (alpha * alpha));
    const double squaredHalfCosine = 0.5 * (1.0 + cosine);
    const double falloff = squaredHalfCosine * (alpha * alpha - 1.0) + 1.0;
    return alpha * alpha / (kPi * falloff * falloff) * cosine;
}

/// The mean of an environment over a lobe, as a sum over all of its texels.
Vec3d averageByHand(const Environment& environment, const Vec3d& axis, ReflectionLobe lobe,
                    double roughness) {
    const Image& image = environment.radiance;
    Vec3d sum(0.0);
    double weightSum = 0.0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const SphereTexel texel = sphereTexel(environment.map, image.width, image.height, x, y);
            const double weight =
                lobeAt(lobe, roughness, texel.direction.dot(axis)) * texel.solidAngle;
            sum += Vec3d(image.at(x, y)) * weight;
            weightSum += weight;
        }
    return sum / weightSum;
}

/// Light of three bands, some of it coloured, nowhere negative.
Lighting makeSmoothLighting() {
    Lighting lighting(3);
    RandomStream random(61, 0);
    for (Vec3d& coefficient : lighting.coefficients)
        for (int channel = 0; channel < 3; ++channel)
            coefficient[channel] = random.nextUnitDouble() - 0.5;
    lighting.coefficients[0] = Vec3d(5.0);
    return lighting;
}

Environment drawSmooth(const Shape& shape, int cellSize) {
    const Lighting lighting = makeSmoothLighting();
    return draw(shape, cellSize, [&](const Vec3d& d) { return Vec3f(reconstruct(lighting, d)); });
}

double largestDifference(const Environment& a, const Environment& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.radiance.pixels.size(); ++i)
        largest = std::max(
            largest, static_cast<double>((a.radiance.pixels[i] - b.radiance.pixels[i]).length()));
    return largest;
}

TEST(Prefilter, KeepsAConstant) {
    constexpr float kRounding = 2e-6f;
    const Vec3f radiance(1.0f, 0.5f, 0.25f);
    for (const Shape& shape : kShapes) {
        for (const ReflectionLobe lobe : {ReflectionLobe::ggx, ReflectionLobe::phong}) {
            const PrefilteredEnvironment prefiltered =
                prefilterEnvironment(draw(shape, 16, [&](const Vec3d&) { return radiance; }),
                                     {.faceSize = 5, .lobe = lobe, .sampleCount = 32});
            ASSERT_EQ(prefiltered.mirrors.size(), 6u);
            std::vector<Environment> cubes = prefiltered.mirrors;
            cubes.push_back(prefiltered.diffuse);
            for (const Environment& cube : cubes) {
                EXPECT_EQ(cube.map, SphereMap::verticalStrip);
                ASSERT_EQ(cube.radiance.height, 30);
                for (const Vec3f& texel : cube.radiance.pixels)
                    EXPECT_NEAR((texel - radiance).length(), 0.0f, kRounding);
            }
        }
    }
}

TEST(Prefilter, AVerySmoothMirrorShowsTheEnvironmentItself) {
    constexpr double kTexelVariation = 0.02;
    const Environment source = drawSmooth(kShapes[0], 64);
    for (const ReflectionLobe lobe : {ReflectionLobe::ggx, ReflectionLobe::phong}) {
        const PrefilteredEnvironment prefiltered = prefilterEnvironment(
            source, {.faceSize = kFaceSize, .roughnesses = {0.0, 0.02, 1e-200}, .lobe = lobe});
        const Environment mirror =
            resample(source, SphereMap::verticalStrip, kFaceSize, 6 * kFaceSize);
        EXPECT_EQ(largestDifference(prefiltered.mirrors[0], mirror), 0.0);
        EXPECT_LT(largestDifference(prefiltered.mirrors[1], mirror), kTexelVariation);
        EXPECT_LT(largestDifference(prefiltered.mirrors[2], mirror), kTexelVariation);
    }
}

/// As light of few bands has it (C5).
TEST(Prefilter, NegativeRadianceCountsAsAnyOther) {
    constexpr double kRounding = 2e-5;
    const Environment source = drawSmooth(kShapes[0], 32);
    Environment darker = source;
    for (Vec3f& texel : darker.radiance.pixels)
        texel -= Vec3f(3.0f);
    const PrefilterOptions options{
        .faceSize = 8, .roughnesses = {0.0, 0.2, 0.7}, .sampleCount = 64};
    const PrefilteredEnvironment light = prefilterEnvironment(source, options);
    PrefilteredEnvironment dark = prefilterEnvironment(darker, options);
    for (std::size_t level = 0; level < 3; ++level) {
        EXPECT_LT(dark.mirrors[level].radiance.at(3, 3).x, 0.0f);
        for (Vec3f& texel : dark.mirrors[level].radiance.pixels)
            texel += Vec3f(3.0f);
        EXPECT_LT(largestDifference(light.mirrors[level], dark.mirrors[level]), kRounding);
    }
}

TEST(Prefilter, AveragesOverTheLobe) {
    constexpr double kSampling = 0.025;  // of light between 0.7 and 2.3
    const Environment source = drawSmooth(kShapes[0], 64);
    const std::vector<double> roughnesses = {0.25, 0.5, 1.0};
    for (const ReflectionLobe lobe : {ReflectionLobe::ggx, ReflectionLobe::phong}) {
        const PrefilteredEnvironment prefiltered = prefilterEnvironment(
            source, {.faceSize = kFaceSize, .roughnesses = roughnesses, .lobe = lobe});
        RandomStream random(62, 0);
        for (int i = 0; i < 40; ++i) {
            const int x = static_cast<int>(random.nextUnitDouble() * kFaceSize);
            const int y = static_cast<int>(random.nextUnitDouble() * 6 * kFaceSize);
            const Vec3d axis =
                sphereTexel(SphereMap::verticalStrip, kFaceSize, 6 * kFaceSize, x, y).direction;
            for (std::size_t level = 0; level < roughnesses.size(); ++level) {
                const Vec3d expected = averageByHand(source, axis, lobe, roughnesses[level]);
                const Vec3d found(prefiltered.mirrors[level].radiance.at(x, y));
                EXPECT_LT((found - expected).length(), kSampling) << roughnesses[level];
            }
        }
    }
}

TEST(Prefilter, DiffuseIsTheIrradianceOverPi) {
    constexpr double kSampling = 0.01;
    const Lighting lighting = makeSmoothLighting();
    const Environment diffuse =
        prefilterEnvironment(drawSmooth(kShapes[0], 64), {.faceSize = kFaceSize, .roughnesses = {}})
            .diffuse;
    const std::vector<double> cosine = clampedCosineZonal(3);
    for (int y = 0; y < 6 * kFaceSize; ++y)
        for (int x = 0; x < kFaceSize; ++x) {
            std::vector<double> lobe(9);
            rotateZonal(cosine, sphereTexel(diffuse.map, kFaceSize, 6 * kFaceSize, x, y).direction,
                        lobe);
            Vec3d irradiance(0.0);
            for (std::size_t i = 0; i < 9; ++i)
                irradiance += lighting.coefficients[i] * lobe[i];
            EXPECT_LT((Vec3d(diffuse.radiance.at(x, y)) - irradiance / kPi).length(), kSampling);
        }
}

TEST(Prefilter, KeepsTheMeanRadiance) {
    constexpr double kPromise = 0.01;
    Environment source = drawSmooth(kShapes[2], 32);
    source.radiance.at(50, 40) = Vec3f(3000.0f, 2000.0f, 1000.0f);
    const Vec3d mean = integrate(source);
    for (const ReflectionLobe lobe : {ReflectionLobe::ggx, ReflectionLobe::phong}) {
        const PrefilteredEnvironment prefiltered =
            prefilterEnvironment(source, {.faceSize = 32, .lobe = lobe});
        std::vector<Environment> cubes = prefiltered.mirrors;
        cubes.push_back(prefiltered.diffuse);
        for (const Environment& cube : cubes) {
            const Vec3d found = integrate(cube);
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(found[channel] / mean[channel], 1.0, kPromise);
        }
    }
}

// What a small sun becomes is the lobe itself: no fireflies around it, no peak but one.
TEST(Prefilter, ASmallSunBecomesTheLobe) {
    // Of the lobe's peak. The widest lobe ends at the horizon, where few directions are drawn.
    constexpr double kSampling = 0.05, kSamplingAtHorizon = 0.09;
    Environment source = draw(kShapes[0], 128, [](const Vec3d&) { return Vec3f(0.0f); });
    source.radiance.at(70, 50) = Vec3f(1e4f);
    const SphereTexel sun = sphereTexel(SphereMap::latLong, 256, 128, 70, 50);
    const std::vector<double> roughnesses = {0.3, 0.5, 0.7, 1.0};
    const int faceSize = 32;
    for (const ReflectionLobe lobe : {ReflectionLobe::ggx, ReflectionLobe::phong}) {
        const PrefilteredEnvironment prefiltered = prefilterEnvironment(
            source, {.faceSize = faceSize, .roughnesses = roughnesses, .lobe = lobe});
        double lastPeak = 1e30;
        for (std::size_t level = 0; level < roughnesses.size(); ++level) {
            const Image& image = prefiltered.mirrors[level].radiance;
            double lobeSum = 0.0;
            for (int i = 0; i < 2000; ++i) {
                const double cosine = (i + 0.5) / 2000;
                lobeSum += lobeAt(lobe, roughnesses[level], cosine) * 2.0 * kPi / 2000;
            }
            const double scale = 1e4 * sun.solidAngle / lobeSum;
            const double truePeak = scale * lobeAt(lobe, roughnesses[level], 1.0);
            double peak = 0.0;
            for (int y = 0; y < image.height; ++y)
                for (int x = 0; x < image.width; ++x) {
                    const Vec3d direction =
                        sphereTexel(SphereMap::verticalStrip, faceSize, image.height, x, y)
                            .direction;
                    const double expected =
                        scale * lobeAt(lobe, roughnesses[level], direction.dot(sun.direction));
                    const auto found = static_cast<double>(image.at(x, y).x);
                    EXPECT_NEAR(found / truePeak, expected / truePeak,
                                roughnesses[level] < 1.0 ? kSampling : kSamplingAtHorizon)
                        << "roughness " << roughnesses[level];
                    peak = std::max(peak, found);
                }
            EXPECT_LT(peak, 0.8 * lastPeak);
            lastPeak = peak;
        }
    }
}

}  // namespace
}  // namespace prt
