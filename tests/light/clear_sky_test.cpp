#include "prt/light/clear_sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prt/light/analytic_lights.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

Vec3d sunAt(double elevationDegrees, double azimuthDegrees = 0.0) {
    const double elevation = elevationDegrees * kDegree, azimuth = azimuthDegrees * kDegree;
    return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
            std::cos(elevation) * std::sin(azimuth)};
}

double luminance(const Vec3d& rgb) {
    return 0.2126729 * rgb.x + 0.7151522 * rgb.y + 0.0721750 * rgb.z;
}

/// Illuminance on the ground by the sky alone, in thousands of lx.
double integrateSky(const ClearSky& sky) {
    double sum = 0.0;
    for (const auto& [direction, weight] : sphereQuadrature(200))
        if (direction.y > 0.0) sum += weight * direction.y * luminance(sky.radiance(direction));
    return sum;
}

// [Preetham99, appendix A1] at the zenith itself, where F cancels: T = 3, sun 60° from the zenith,
// worked by hand from the printed tables.
TEST(ClearSky, HasThePublishedLuminanceAndColourAtTheZenith) {
    const ClearSky sky(sunAt(30.0), 3.0);
    const Vec3d zenith = sky.radiance(Vec3d(0, 1, 0));
    const double chi = (4.0 / 9.0 - 3.0 / 120.0) * (kPi - 2.0 * kPi / 3.0);
    const double truth = (4.0453 * 3.0 - 4.9710) * std::tan(chi) - 0.2155 * 3.0 + 2.4192;
    EXPECT_NEAR(luminance(zenith), truth, 1e-4 * truth);
    EXPECT_NEAR(truth, 5.1392, 1e-4);
    // x = 0.24493, y = 0.25257 by the tables: a deep blue.
    const Vec3d xyz(0.4124564 * zenith.x + 0.3575761 * zenith.y + 0.1804375 * zenith.z,
                    luminance(zenith),
                    0.0193339 * zenith.x + 0.1191920 * zenith.y + 0.9503041 * zenith.z);
    const double sum = xyz.x + xyz.y + xyz.z;
    EXPECT_NEAR(xyz.x / sum, 0.24493, 2e-5);
    EXPECT_NEAR(xyz.y / sum, 0.25257, 2e-5);
}

TEST(ClearSky, IsOfTheBrightnessOfMeasuredSkies) {
    // Clear skies give some 8 to 20 klx on the ground, to which the model adds a third under a high
    // sun; the sun gives 70 to 110 klx facing it when high, some 10 klx by 5° of elevation.
    const ClearSky noon(sunAt(60.0), 2.5);
    EXPECT_GT(integrateSky(noon), 8.0);
    EXPECT_LT(integrateSky(noon), 30.0);
    EXPECT_GT(luminance(noon.sunIrradiance()), 70.0);
    EXPECT_LT(luminance(noon.sunIrradiance()), 110.0);
    const double evening = luminance(ClearSky(sunAt(5.0), 2.5).sunIrradiance());
    EXPECT_GT(evening, 3.0);
    EXPECT_LT(evening, 30.0);
}

TEST(ClearSky, TheSunReddensAndDimsAsItSinksAndInHaze) {
    double lastRed = 0.0, lastLuminance = 1e9;
    for (const double elevation : {90.0, 45.0, 20.0, 10.0, 3.0}) {
        const Vec3d sun = ClearSky(sunAt(elevation), 3.0).sunIrradiance();
        EXPECT_GT(sun.x / luminance(sun), lastRed);
        EXPECT_LT(luminance(sun), lastLuminance);
        lastRed = sun.x / luminance(sun);
        lastLuminance = luminance(sun);
    }
    EXPECT_LT(luminance(ClearSky(sunAt(45.0), 6.0).sunIrradiance()),
              luminance(ClearSky(sunAt(45.0), 2.0).sunIrradiance()));
}

TEST(ClearSky, IsFiniteAndNotNegativeForEverySun) {
    for (const double turbidity : {2.0, 3.0, 6.0, 10.0})
        for (const double elevation : {0.0, 1.0, 30.0, 90.0}) {
            const ClearSky sky(sunAt(elevation), turbidity);
            for (const auto& [direction, weight] : sphereQuadrature(20)) {
                const Vec3d radiance = sky.radiance(direction);
                for (int channel = 0; channel < 3; ++channel) {
                    EXPECT_TRUE(std::isfinite(radiance[channel]));
                    EXPECT_GE(radiance[channel], 0.0);
                }
                if (direction.y < 0.0) {
                    EXPECT_EQ(radiance, Vec3d(0.0));
                }
            }
        }
}

TEST(ClearSky, TurnsWithItsSun) {
    constexpr double kQuadrature = 1e-4;
    const Lighting a = skyLighting(ClearSky(sunAt(30.0, 0.0), 3.0), 5);
    const Lighting b = skyLighting(ClearSky(sunAt(30.0, 70.0), 3.0), 5);
    // Azimuth runs from +x to +z, against rotationY.
    const Lighting turned = rotate(a, rotationY(-70.0 * kDegree));
    for (std::size_t i = 0; i < b.coefficients.size(); ++i)
        EXPECT_NEAR((turned.coefficients[i] - b.coefficients[i]).length(), 0.0,
                    kQuadrature * b.coefficients[0].length());
}

TEST(ClearSky, LightingIsTheProjectionOfTheDrawnSky) {
    constexpr double kTexels = 2e-3;
    for (const bool withSun : {false, true}) {
        const ClearSky sky(sunAt(40.0, 200.0), 3.0);
        const Lighting drawn = projectLighting(drawSky(sky, 2048, withSun), 5);
        const Lighting lighting = withSun ? daylightLighting(sky, 5) : skyLighting(sky, 5);
        for (std::size_t i = 0; i < 25; ++i)
            EXPECT_NEAR((drawn.coefficients[i] - lighting.coefficients[i]).length(), 0.0,
                        kTexels * lighting.coefficients[0].length())
                << i << " " << withSun;
    }
}

TEST(ClearSky, TheDrawnSunHasItsIrradianceAtAnySize) {
    for (const double elevation : {0.2, 35.0, 90.0})
        for (const int width : {2, 64, 1024}) {
            const ClearSky sky(sunAt(elevation, 10.0), 3.0);
            const Image with = drawSky(sky, width, true).radiance;
            const Image without = drawSky(sky, width, false).radiance;
            Vec3d sum(0.0);
            for (int y = 0; y < with.height; ++y)
                for (int x = 0; x < width; ++x)
                    sum += Vec3d(with.at(x, y) - without.at(x, y)) *
                           sphereTexel(SphereMap::latLong, width, width / 2, x, y).solidAngle;
            EXPECT_NEAR((sum - sky.sunIrradiance()).length(), 0.0, 1e-3 * sum.length());
        }
}

}  // namespace
}  // namespace prt
