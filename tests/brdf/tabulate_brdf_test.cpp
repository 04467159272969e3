#include "prt/brdf/tabulate_brdf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "prt/brdf/brdf_matrix.h"
#include "tests/brdf/brdf_samples.h"

namespace prt {
namespace {

using test::drawUpward;

/// At the middles of cells, by the tests' own table.
TEST(TabulateBrdf, HoldsWhatMeasuringWouldGive) {
    constexpr double kFloatRounding = 1e-6;
    const Brdf plastic = makeGltfBrdf(Vec3f(0.6f, 0.3f, 0.1f), {.roughness = 0.5f});
    const std::vector<float> expected =
        test::measureTable([&](const Vec3d& incident, const Vec3d& view) {
            return evaluateBrdf(plastic, incident, view);
        });
    const MeasuredBrdf table = tabulateBrdf(plastic);
    ASSERT_EQ(table.values().size(), expected.size());
    double largest = 0.0;
    std::size_t darkCount = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto value = static_cast<double>(expected[i]);
        largest = std::max(
            largest, std::abs(static_cast<double>(table.values()[i]) - value) / (1.0 + value));
        darkCount += table.values()[i] == 0.0f;
    }
    EXPECT_LT(largest, kFloatRounding);
    EXPECT_GT(darkCount, expected.size() / 5) << "below the horizon";
}

TEST(TabulateBrdf, OfGgxEvaluatesAndReflectsAsGgx) {
    constexpr double kMeanVariation = 0.04;  // within a cell
    constexpr double kAlbedo = 0.01;
    const Brdf metal = test::makeGgx(0.5);
    const Brdf table{
        .lobes = {MeasuredLobe{std::make_shared<const MeasuredBrdf>(tabulateBrdf(metal))}}};
    RandomStream random(1, 0);
    double squares = 0.0, norm = 0.0;
    for (int i = 0; i < 20'000; ++i) {
        const Vec3d incident = drawUpward(random), view = drawUpward(random);
        if (std::min(incident.z, view.z) < 0.1) continue;
        const double expected = evaluateBrdf(metal, incident, view).x;
        squares += std::pow(evaluateBrdf(table, incident, view).x - expected, 2);
        norm += expected * expected;
    }
    EXPECT_LT(std::sqrt(squares / norm), kMeanVariation);
    for (const double degrees : {0.0, 30.0, 60.0}) {
        const double expected = projectBrdfView(metal, test::viewAt(degrees), 1)[0][0];
        EXPECT_NEAR(projectBrdfView(table, test::viewAt(degrees), 1)[0][0], expected,
                    kAlbedo * expected)
            << degrees;
    }
}

TEST(TabulateBrdf, IsFiniteOfTheNarrowestAndTheBrightest) {
    const Brdf brdf{.lobes = {LambertLobe{Vec3d(1e300, 0.0, 0.0)},
                              GgxLobe{.f0 = Vec3d(0.0, 0.5, 1.0), .alpha = 0.0}}};
    const MeasuredBrdf table = tabulateBrdf(brdf);
    EXPECT_TRUE(std::all_of(table.values().begin(), table.values().end(),
                            [](float value) { return std::isfinite(value) && value >= 0.0f; }));
    const Vec3d up(0.0, 0.0, 1.0);
    EXPECT_EQ(table.evaluate(up, up).x, static_cast<double>(std::numeric_limits<float>::max()));
    EXPECT_GT(table.evaluate(up, up).z, 1e6);
}

}  // namespace
}  // namespace prt
