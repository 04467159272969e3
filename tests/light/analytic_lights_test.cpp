#include "prt/light/analytic_lights.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "prt/basis/zonal.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-12;
// The transfer vector is in float.
constexpr double kFloatTolerance = 5e-6;

/// Exit radiance of an unshadowed white diffuse receiver: Σ T_i L_i (C7).
Vec3d relight(const Lighting& lighting, const Vec3d& normal) {
    std::vector<float> transfer(lighting.coefficients.size());
    unshadowedTransfer(Vec3f(normal), lighting.bandCount, transfer);
    Vec3d radiance(0.0);
    for (std::size_t i = 0; i < transfer.size(); ++i) {
        radiance += lighting.coefficients[i] * static_cast<double>(transfer[i]);
    }
    return radiance;
}

// T-31
TEST(UniformLighting, IsConstant) {
    const Lighting lighting = uniformLighting(Vec3d(1.0, 2.0, 3.0), 4);
    EXPECT_NEAR(lighting.coefficients[0].x, 2.0 * std::sqrt(kPi), kRounding);
    for (std::size_t i = 1; i < 16; ++i)
        EXPECT_EQ(lighting.coefficients[i], Vec3d(0.0));
}

// A4
TEST(UniformLighting, LightsAConvexObjectByItsOwnRadiance) {
    for (const auto& [normal, weight] : sphereQuadrature(4)) {
        const Vec3d radiance = relight(uniformLighting(Vec3d(1.0, 2.0, 3.0), 6), normal);
        EXPECT_NEAR((radiance - Vec3d(1.0, 2.0, 3.0)).length(), 0.0, kFloatTolerance);
    }
}

// A5
TEST(DiscLighting, ABrightHemisphereLightsAsHalfOfOnePlusTheCosine) {
    const Vec3d up(0.0, 1.0, 0.0);
    for (int bandCount = 2; bandCount <= 10; ++bandCount) {
        const Lighting sky = discLighting(up, kPi / 2, Vec3d(1.0), bandCount);
        for (const auto& [normal, weight] : sphereQuadrature(4)) {
            EXPECT_NEAR(relight(sky, normal).x, 0.5 * (1.0 + normal.dot(up)), kFloatTolerance);
        }
    }
    const Lighting polar = discLighting(Vec3d(0, 0, 1), kPi / 2, Vec3d(1.0), 2);
    EXPECT_NEAR(polar.coefficients[0].x, 1.772453851, 1e-9);
    EXPECT_NEAR(polar.coefficients[2].x, 1.534990062, 1e-9);
}

TEST(DiscLighting, IsTheIntegralOverTheDisc) {
    const Vec3d axis = Vec3d(2.0, -1.0, 2.0) / 3.0;
    const double halfAngle = 0.6;
    constexpr int kBandCount = 5;
    const Lighting lighting = discLighting(axis, halfAngle, Vec3d(1.0, 0.0, 2.0), kBandCount);

    // Integrate over the cap by stretching a sphere rule's height from [−1, 1] to [cos α, 1].
    std::array<double, 25> integral{}, values{};
    const double low = std::cos(halfAngle);
    for (const auto& [node, weight] : sphereQuadrature(60)) {
        const double z = low + (1.0 - low) * 0.5 * (node.z + 1.0);
        const double stretch = std::sqrt((1.0 - z * z) / (1.0 - node.z * node.z));
        const Vec3d side = Vec3d(1.0, 2.0, 0.0) / std::sqrt(5.0), other = axis.cross(side);
        evaluateSh(side * (node.x * stretch) + other * (node.y * stretch) + axis * z, kBandCount,
                   values);
        for (std::size_t i = 0; i < 25; ++i)
            integral[i] += weight * 0.5 * (1.0 - low) * values[i];
    }
    for (std::size_t i = 0; i < 25; ++i) {
        EXPECT_NEAR(lighting.coefficients[i].x, integral[i], 1e-10);
        EXPECT_EQ(lighting.coefficients[i].y, 0.0);
        EXPECT_NEAR(lighting.coefficients[i].z, 2.0 * integral[i], 2e-10);
    }
}

TEST(SunLighting, GivesUnitIrradianceWhateverItsSize) {
    // Irradiance of the untruncated light is Σ A_l L_l0 y_l0 over all
    // degrees; 400 leave 1e-4 of the tail.
    constexpr int kBandCount = 400;
    constexpr double kTail = 1e-4;
    const auto cosine = clampedCosineZonal(kBandCount);
    for (const double halfAngle : {0.3, 1.0, kPi / 2, 2.5, kPi}) {
        const Lighting sun = sunLighting(Vec3d(0, 0, 1), halfAngle, kBandCount);
        double irradiance = 0.0;
        for (int l = 0; l < kBandCount; ++l) {
            irradiance += cosine[static_cast<std::size_t>(l)] *
                          sun.coefficients[static_cast<std::size_t>(shIndex(l, 0))].x;
        }
        EXPECT_NEAR(irradiance, 1.0, kTail) << halfAngle;
    }
}

TEST(SunLighting, BecomesADirectionalLightAsItShrinks) {
    const Vec3d direction = Vec3d(2.0, -1.0, 2.0) / 3.0;
    const Lighting point = sunLighting(direction, 0.0, 6);
    std::vector<double> values(36);
    evaluateSh(direction, 6, values);
    for (const double halfAngle : {1e-6, 1e-12}) {
        const Lighting disc = sunLighting(direction, halfAngle, 6);
        for (std::size_t i = 0; i < 36; ++i) {
            EXPECT_EQ(point.coefficients[i], Vec3d(values[i]));
            EXPECT_NEAR(disc.coefficients[i].x, values[i], 1e-10);
        }
    }
}

// Truncated to n bands, the light that gives exit radiance 1 to a facing
// surface is stronger by these factors.
TEST(SunLighting, ExitRadianceAfterTruncationIsThePublishedOne) {
    const struct {
        int bandCount;
        double factor;
    } table[] = {{2, 4.188790}, {3, 2.956793}, {4, 2.956793},
                 {5, 3.242934}, {6, 3.242934}, {7, 3.081409}};
    for (const auto& [bandCount, factor] : table) {
        const Vec3d direction = Vec3d(2.0, -1.0, 2.0) / 3.0;
        EXPECT_NEAR(factor * relight(sunLighting(direction, 0.0, bandCount), direction).x, 1.0,
                    kFloatTolerance);
    }
}

TEST(SphereLighting, GivesTheIrradianceOfTheInverseSquareLaw) {
    // A facing surface sees π (r/d)² of a sphere, whatever its distance [view factor of a sphere];
    // 300 bands leave 1e-4 of the tail.
    constexpr int kBandCount = 300;
    const auto cosine = clampedCosineZonal(kBandCount);
    for (const double distance : {1.5, 2.0, 5.0}) {
        const Lighting sphere = sphereLighting(Vec3d(0, 0, distance), 1.0, Vec3d(1.0), kBandCount);
        double irradiance = 0.0;
        for (int l = 0; l < kBandCount; ++l)
            irradiance += cosine[static_cast<std::size_t>(l)] *
                          sphere.coefficients[static_cast<std::size_t>(shIndex(l, 0))].x;
        EXPECT_NEAR(irradiance, kPi / (distance * distance), 1e-4);
    }
}

TEST(SphereLighting, IsUniformFromInside) {
    EXPECT_EQ(sphereLighting(Vec3d(0.1, 0, 0), 1.0, Vec3d(2.0), 3).coefficients,
              uniformLighting(Vec3d(2.0), 3).coefficients);
}

TEST(HemisphereLighting, BlendsSkyAndGroundByTheNormal) {
    const Vec3d up = Vec3d(1.0, 2.0, -2.0) / 3.0, sky(0.2, 0.4, 1.0), ground(0.3, 0.2, 0.1);
    for (int bandCount = 2; bandCount <= 6; ++bandCount) {
        const Lighting lighting = hemisphereLighting(up, sky, ground, bandCount);
        for (const auto& [normal, weight] : sphereQuadrature(4)) {
            const double t = 0.5 * (1.0 + normal.dot(up));
            EXPECT_NEAR((relight(lighting, normal) - (sky * t + ground * (1.0 - t))).length(), 0.0,
                        kFloatTolerance);
        }
    }
}

TEST(GradientLighting, GoesLinearlyFromBottomToTop) {
    const Vec3d up = Vec3d(1.0, 2.0, -2.0) / 3.0, top(0.2, 0.4, 1.0), bottom(0.3, 0.2, 0.1);
    for (int bandCount = 2; bandCount <= 4; ++bandCount) {
        const Lighting lighting = gradientLighting(up, top, bottom, bandCount);
        for (const auto& [direction, weight] : sphereQuadrature(4)) {
            const double t = 0.5 * (1.0 + direction.dot(up));
            EXPECT_NEAR(
                (reconstruct(lighting, direction) - (top * t + bottom * (1.0 - t))).length(), 0.0,
                kRounding);
        }
    }
    EXPECT_EQ(gradientLighting(up, top, bottom, 1).coefficients,
              uniformLighting((top + bottom) * 0.5, 1).coefficients);
}

TEST(DirectionalLighting, IsADeltaOfItsIrradiance) {
    const Vec3d direction = Vec3d(2.0, -1.0, 2.0) / 3.0;
    const Lighting light = directionalLighting(direction, Vec3d(3.0, 2.0, 1.0), 6);
    EXPECT_NEAR(light.coefficients[0].x, 3.0 * 0.28209479177387814, kRounding);
    // Σ_m y_lm² = (2l + 1) / 4π.
    EXPECT_NEAR(reconstruct(light, direction).z, 36.0 / (4.0 * kPi), kRounding);
}

}  // namespace
}  // namespace prt
