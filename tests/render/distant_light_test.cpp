#include "prt/render/distant_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "prt/light/analytic_lights.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSampleCount = 100'000;
constexpr double kSigmas = 4.0;

/// The mean of radiance over density is the integral of the radiance: red alone is looked at.
struct DrawnLight {
    Vec3d flux{0.0, 0.0, 0.0};  // ∫ L ω dω
    double total = 0.0;         // ∫ L dω
    double standardError = 0.0;
};

DrawnLight draw(const DistantLight& light) {
    DrawnLight drawn;
    RandomStream random(3, 0);
    double squares = 0.0;
    for (int i = 0; i < kSampleCount; ++i) {
        const LightSample sample = light.sample(random);
        const auto value = static_cast<double>(sample.radianceOverDensity.x);
        drawn.flux += Vec3d(sample.direction) * (value / kSampleCount);
        drawn.total += value / kSampleCount;
        squares += value * value / kSampleCount;
    }
    drawn.standardError = std::sqrt((squares - drawn.total * drawn.total) / kSampleCount);
    return drawn;
}

/// What is drawn has the density and the radiance that evaluate() tells.
void expectSamplesAndValuesAgree(const DistantLight& light, int disagreementsAllowed) {
    constexpr double kFloatRounding = 1e-3;
    RandomStream random(5, 0);
    int disagreements = 0;
    for (int i = 0; i < 10'000; ++i) {
        const LightSample sample = light.sample(random);
        if (sample.density == 0.0) continue;
        const LightValue value = light.evaluate(sample.direction);
        const double radiance = static_cast<double>(sample.radianceOverDensity.x) * sample.density;
        const double scale = std::abs(radiance) + 1e-3;
        if (std::abs(value.density / sample.density - 1.0) > kFloatRounding ||
            std::abs(static_cast<double>(value.radiance.x) - radiance) > kFloatRounding * scale)
            ++disagreements;
    }
    EXPECT_LE(disagreements, disagreementsAllowed);
}

/// ∫ density dω over the sphere.
double integrateDensity(const DistantLight& light) {
    double sum = 0.0;
    for (const SphereNode& node : sphereQuadrature(400))
        sum += node.weight * light.evaluate(Vec3f(node.direction)).density;
    return sum;
}

TEST(SunLight, GivesUnitIrradianceWhateverItsSize) {
    const Vec3d direction = Vec3d(0.3, -0.5, 0.8).normalized();
    for (const double degrees : {0.0, 0.05, 0.27, 10.0, 60.0, 90.0}) {
        const auto light = makeSunLight(direction, degrees * kPi / 180.0);
        const DrawnLight drawn = draw(*light);
        EXPECT_NEAR(drawn.flux.dot(direction), 1.0, 5e-3) << degrees;
        EXPECT_NEAR(drawn.flux.cross(direction).length(), 0.0, 5e-3) << degrees;
        if (degrees > 0.0) expectSamplesAndValuesAgree(*light, 0);
    }
}

TEST(SunLight, EndsAtItsRim) {
    const double halfAngle = 0.27 * kPi / 180.0;
    const auto light = makeSunLight(Vec3d(0.0, 0.0, 1.0), halfAngle);
    const auto at = [&](double angle) {
        return light->evaluate(
            Vec3f(static_cast<float>(std::sin(angle)), 0.0f, static_cast<float>(std::cos(angle))));
    };
    EXPECT_NEAR(at(0.99 * halfAngle).radiance.x, 1.0 / (kPi * std::pow(std::sin(halfAngle), 2)),
                1.0);
    EXPECT_EQ(at(1.01 * halfAngle).radiance.x, 0.0f);
    EXPECT_EQ(at(1.01 * halfAngle).density, 0.0);
}

TEST(SunLight, WithoutExtentIsDrawnButNeverMet) {
    const auto light = makeSunLight(Vec3d(0.0, 1.0, 0.0), 0.0);
    RandomStream random(1, 0);
    const LightSample sample = light->sample(random);
    EXPECT_EQ(sample.direction, Vec3f(0.0f, 1.0f, 0.0f));
    EXPECT_EQ(sample.radianceOverDensity, Vec3f(1.0f));
    EXPECT_TRUE(std::isinf(sample.density));
    EXPECT_EQ(light->evaluate(Vec3f(0.0f, 1.0f, 0.0f)).radiance, Vec3f(0.0f));
}

TEST(BandLimitedLight, KeepsItsNegativeLobes) {
    const Vec3d axis(0.0, 0.0, 1.0);
    const Lighting lighting = sunLighting(axis, 0.0, 5);
    const auto light = makeBandLimitedLight(lighting);
    float lowest = 0.0f;
    for (const SphereNode& node : sphereQuadrature(20)) {
        const float value = light->evaluate(Vec3f(node.direction)).radiance.x;
        EXPECT_NEAR(value, reconstruct(lighting, node.direction).x, 1e-5);
        lowest = std::min(lowest, value);
    }
    EXPECT_LT(lowest, -0.1f);
    const DrawnLight drawn = draw(*light);
    EXPECT_NEAR(drawn.total, std::sqrt(4.0 * kPi) * lighting.coefficients[0].x,
                kSigmas * drawn.standardError);
    EXPECT_NEAR(drawn.flux.z, std::sqrt(4.0 * kPi / 3.0) * lighting.coefficients[2].x, 0.01);
    expectSamplesAndValuesAgree(*light, 20);
    EXPECT_NEAR(integrateDensity(*light), 1.0, 0.01);
}

/// Different radiance in every texel, some of it black, one of it bright.
Environment makeEnvironment(SphereMap map, int width, int height) {
    Environment environment{map, Image(width, height)};
    RandomStream random(9, 0);
    for (Vec3f& texel : environment.radiance.pixels)
        texel = Vec3f(random.nextUnitFloat() < 0.3f ? 0.0f : random.nextUnitFloat());
    environment.radiance.at(width / 2, height / 2) = Vec3f(100.0f);
    return environment;
}

TEST(EnvironmentLight, HoldsTheLightOfItsTexelsInEveryLayout) {
    struct Layout {
        SphereMap map;
        int width, height;
    };
    constexpr Layout kLayouts[] = {
        {SphereMap::latLong, 32, 16},       {SphereMap::angularMap, 32, 32},
        {SphereMap::verticalCross, 24, 32}, {SphereMap::horizontalCross, 32, 24},
        {SphereMap::verticalStrip, 8, 48},  {SphereMap::horizontalStrip, 48, 8},
        {SphereMap::octahedral, 32, 32},
    };
    for (const auto& [map, width, height] : kLayouts) {
        const Environment environment = makeEnvironment(map, width, height);
        double expected = 0.0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                expected += sphereTexel(map, width, height, x, y).solidAngle *
                            static_cast<double>(environment.radiance.at(x, y).x);
        const auto light = makeEnvironmentLight(environment, rotationX(0.4) * rotationZ(2.0));
        const DrawnLight drawn = draw(*light);
        EXPECT_NEAR(drawn.total, expected, kSigmas * drawn.standardError + 1e-4 * expected)
            << sphereMapName(map);
        // Rounding takes some directions to the next texel.
        expectSamplesAndValuesAgree(*light, 20);
        EXPECT_NEAR(integrateDensity(*light), 1.0, 0.03) << sphereMapName(map);
    }
}

TEST(EnvironmentLight, TurnsAsItsCoefficientsDo) {
    Environment environment{SphereMap::latLong, Image(64, 32)};
    environment.radiance.at(5, 9) = Vec3f(50.0f);
    const Mat3d rotation = rotationY(1.0) * rotationX(0.5);
    const Lighting lighting = rotate(projectLighting(environment, 2), rotation);
    const DrawnLight drawn = draw(*makeEnvironmentLight(environment, rotation));
    // y₁₋₁, y₁₀, y₁₁ are −y, z and −x times √(3/4π).
    const double scale = std::sqrt(4.0 * kPi / 3.0);
    EXPECT_NEAR(drawn.flux.x, -scale * lighting.coefficients[3].x, 1e-3);
    EXPECT_NEAR(drawn.flux.y, -scale * lighting.coefficients[1].x, 1e-3);
    EXPECT_NEAR(drawn.flux.z, scale * lighting.coefficients[2].x, 1e-3);
}

TEST(EnvironmentLight, MayBeBlack) {
    const DrawnLight drawn = draw(*makeEnvironmentLight({SphereMap::latLong, Image(8, 4)}));
    EXPECT_EQ(drawn.total, 0.0);
}

}  // namespace
}  // namespace prt
