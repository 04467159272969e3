#include "prt/brdf/measured_brdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/brdf/brdf_samples.h"

namespace prt {
namespace {

using test::drawUpward;

/// Half a cell off the middle of the cell that answers: 0.5° of each difference angle, and of the
/// half angle what the square makes of it.
TEST(MeasuredBrdf, IsWhatWasMeasuredWithinItsCells) {
    const Brdf plastic = makeGltfBrdf(Vec3f(0.6f, 0.3f, 0.1f), {.roughness = 0.5f});
    const Brdf& measured = test::measuredPlastic();
    constexpr double kCellVariation = 0.15;  // at the flank of the highlight
    constexpr double kMeanVariation = 0.05;
    RandomStream random(1, 0);
    double squares = 0.0, norm = 0.0;
    int count = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Vec3d incident = drawUpward(random), view = drawUpward(random);
        // Towards the horizon a cell reaches below it.
        if (std::min(incident.z, view.z) < 0.1) continue;
        const Vec3d expected = evaluateBrdf(plastic, incident, view);
        const Vec3d actual = evaluateBrdf(measured, incident, view);
        ASSERT_NEAR((actual - expected).length(), 0.0, kCellVariation * expected.length());
        squares += (actual - expected).length2();
        norm += expected.length2();
        ++count;
    }
    EXPECT_GT(count, 15'000);
    EXPECT_LT(std::sqrt(squares / norm), kMeanVariation);
}

TEST(MeasuredBrdf, ATableOfOneValueIsThatValueInEveryDirection) {
    const MeasuredBrdf gray(std::vector<float>(3 * MeasuredBrdf::kCellCount, 0.25f));
    RandomStream random(2, 0);
    for (int i = 0; i < 1000; ++i)
        EXPECT_EQ(gray.evaluate(drawUpward(random), drawUpward(random)), Vec3d(0.25));
    for (const double degrees : {0.0, 1e-7, 89.999})
        EXPECT_EQ(gray.evaluate(test::viewAt(degrees), test::viewAt(degrees)), Vec3d(0.25));
}

/// Each cell holds its own azimuth: which way φ_d turns is seen.
TEST(MeasuredBrdf, AzimuthsAreCountedFromTheHalfVectorsPlane) {
    std::vector<float> values(3 * MeasuredBrdf::kCellCount);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<float>(i % MeasuredBrdf::kAzimuthCount);
    const MeasuredBrdf measured(values);
    RandomStream random(3, 0);
    for (int i = 0; i < 1000; ++i) {
        // By the definition: ω_i turned back by φ_h and then by θ_h.
        const Vec3d incident = drawUpward(random), view = drawUpward(random);
        const Vec3d half = (incident + view).normalized();
        const double phiHalf = std::atan2(half.y, half.x), thetaHalf = std::acos(half.z);
        const double alongX = std::cos(phiHalf) * incident.x + std::sin(phiHalf) * incident.y;
        const double y = std::cos(phiHalf) * incident.y - std::sin(phiHalf) * incident.x;
        const double x = std::cos(thetaHalf) * alongX - std::sin(thetaHalf) * incident.z;
        const double degrees = std::atan2(y, x) * 180.0 / std::numbers::pi;
        EXPECT_EQ(measured.evaluate(incident, view).x,
                  std::floor(degrees < 0.0 ? degrees + 180.0 : degrees));
    }
}

TEST(MeasuredBrdf, ABlackTableCanBeDrawnFrom) {
    const Brdf black{.lobes = {MeasuredLobe{std::make_shared<MeasuredBrdf>(
                         std::vector<float>(3 * MeasuredBrdf::kCellCount, 0.0f))}}};
    RandomStream random(4, 0);
    for (int i = 0; i < 1000; ++i) {
        const double u = random.nextUnitDouble();
        const BrdfSample sample = sampleBrdf(black, drawUpward(random), u, random.nextUnitDouble());
        EXPECT_TRUE(std::isfinite(sample.density));
        EXPECT_EQ(sample.weight, Vec3d(0.0));
    }
}

}  // namespace
}  // namespace prt
