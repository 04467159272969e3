#include "prt/brdf/specular_albedo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "prt/base/random.h"
#include "tests/brdf/brdf_samples.h"

namespace prt {
namespace {

using test::viewAt;

/// The directional albedo as sampling has it: the mean weight.
Vec3d sampleAlbedo(const Brdf& brdf, const Vec3d& view) {
    constexpr int kSide = 128;
    Vec3d sum(0.0);
    for (int i = 0; i < kSide * kSide; ++i)
        sum += sampleBrdf(brdf, view, (i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide).weight;
    return sum / (kSide * kSide);
}

TEST(SpecularAlbedo, IsTheMeanWeightOfSamples) {
    constexpr double kTolerance = 0.004;  // of linear interpolation
    const SpecularAlbedoTable table;
    const Vec3f f0(0.9f, 0.3f, 0.04f);
    RandomStream random(8, 0);
    for (int i = 0; i < 60; ++i) {
        const double roughness = 0.1 + 0.9 * random.nextUnitDouble();
        const Vec3d view = viewAt(85.0 * random.nextUnitDouble());
        const Brdf brdf{.lobes = {GgxLobe{.f0 = Vec3d(f0), .alpha = roughness * roughness}}};
        const Vec3d expected = sampleAlbedo(brdf, view);
        const Vec3f found =
            table.evaluate(f0, static_cast<float>(roughness), static_cast<float>(view.z));
        EXPECT_LT((Vec3d(found) - expected).length(), kTolerance) << roughness << " " << view.z;
    }
}

TEST(SpecularAlbedo, AMirrorReflectsWhatFresnelSays) {
    constexpr double kTolerance = 0.01;  // between views near the horizon, where F is steep
    const SpecularAlbedoTable table;
    for (const double degrees : {0.0, 30.0, 60.0, 80.0}) {
        const double z = viewAt(degrees).z;
        EXPECT_NEAR(table.evaluate(Vec3f(0.04f), 0.0f, static_cast<float>(z)).x,
                    0.04 + 0.96 * std::pow(1.0 - z, 5.0), kTolerance)
            << degrees;
    }
    // At the horizon and below.
    EXPECT_NEAR(table.evaluate(Vec3f(0.5f), 0.0f, 0.0f).x, 1.0f, 0.02f);
    EXPECT_EQ(table.evaluate(Vec3f(0.5f), 0.3f, -0.2f), table.evaluate(Vec3f(0.5f), 0.3f, 0.0f));
}

}  // namespace
}  // namespace prt
