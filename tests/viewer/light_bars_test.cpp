#include "apps/viewer/light_bars.h"

#include <gtest/gtest.h>

#include "prt/base/random.h"
#include "prt/light/analytic_lights.h"

namespace prt::viewer {
namespace {

Lighting sampleLighting(int bandCount) {
    RandomStream random(5, 0);
    Lighting lighting(bandCount);
    for (Vec3d& value : lighting.coefficients)
        value =
            Vec3d(random.nextUnitDouble() - 0.5, random.nextUnitDouble(), -random.nextUnitDouble());
    return lighting;
}

TEST(BandEnergies, AddUpToTheEnergyOfTheLight) {
    constexpr double kRounding = 1e-12;
    const Lighting lighting = sampleLighting(6);
    Vec3d sum(0.0), squares(0.0);
    for (const Vec3d& energy : bandEnergies(lighting))
        sum += energy;
    for (const Vec3d& value : lighting.coefficients)
        squares += value * value;
    EXPECT_NEAR((sum - squares).length(), 0.0, kRounding);
}

TEST(BandEnergies, StayWhenTheLightTurns) {
    constexpr double kRounding = 1e-12;
    const Lighting lighting = sampleLighting(6);
    const auto before = bandEnergies(lighting);
    const auto after = bandEnergies(rotate(lighting, rotationX(0.7) * rotationY(-2.0)));
    ASSERT_EQ(after.size(), 6u);
    for (std::size_t l = 0; l < after.size(); ++l)
        EXPECT_NEAR((after[l] - before[l]).length(), 0.0, kRounding);
}

TEST(BandEnergies, OfUniformLightLieInTheFirstBand) {
    const auto energies = bandEnergies(uniformLighting(Vec3d(2.0, 1.0, 0.0), 3));
    EXPECT_NEAR(energies[0].x, 16.0 * 3.14159265358979, 1e-12);  // 4π radiance²
    EXPECT_EQ(energies[1].length(), 0.0);
    EXPECT_EQ(energies[2].length(), 0.0);
}

}  // namespace
}  // namespace prt::viewer
