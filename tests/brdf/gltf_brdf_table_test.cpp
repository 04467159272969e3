#include "prt/brdf/gltf_brdf_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/brdf/brdf_samples.h"

namespace prt {
namespace {

double largestDifference(const BrdfMatrix& a, const BrdfMatrix& b) {
    EXPECT_EQ(a.values.size(), b.values.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i)
        largest = std::max(largest, std::abs(a.values[i] - b.values[i]));
    return largest;
}

/// The same for the table and for what it is held against, so that it need not be fine.
constexpr BrdfProjectionOptions kCoarse{
    .quadrature = {.polarNodeCount = 48, .azimuthNodeCount = 16, .viewNodeCount = 12}};

TEST(GltfBrdfTable, HoldsEveryMaterial) {
    constexpr double kInterpolation = 5e-4;  // beside a largest element of ½
    const GltfBrdfTable table(kCoarse);
    RandomStream random(1, 0);
    for (int i = 0; i < 8; ++i) {
        const Vec3f baseColor(random.nextUnitFloat(), random.nextUnitFloat(),
                              random.nextUnitFloat());
        const MetallicRoughness surface{.metallic = random.nextUnitFloat(),
                                        .roughness = random.nextUnitFloat()};
        const auto looked = table.project(baseColor, surface);
        const auto projected = projectBrdf(makeGltfBrdf(baseColor, surface), kCoarse);
        for (std::size_t channel = 0; channel < 3; ++channel)
            EXPECT_LT(largestDifference(looked[channel], projected[channel]), kInterpolation)
                << "roughness " << surface.roughness;
    }
}

TEST(GltfBrdfTable, IsExactAtItsLevels) {
    constexpr double kRounding = 1e-9;  // √α of a float
    const GltfBrdfTable table({.incidentBandCount = 3, .viewBandCount = 4}, 9);
    for (const double roughness : {0.0, 0.125, 0.5, 0.875, 1.0}) {
        const auto projected =
            projectBrdf(test::makeGgx(roughness), {.incidentBandCount = 3, .viewBandCount = 4});
        EXPECT_LT(largestDifference(table.specular(roughness).bright, projected[0]), kRounding);
    }
}

// Between levels, with a quadrature so fine that interpolation alone is seen.
TEST(GltfBrdfTable, InterpolationErrsLittle) {
    constexpr double kInterpolation = 2.5e-4;  // beside ½, at most 2e-4 seen
    const BrdfProjectionOptions options{
        .incidentBandCount = 5,
        .viewBandCount = 5,
        .quadrature = {.polarNodeCount = 160, .azimuthNodeCount = 16, .viewNodeCount = 8}};
    const GltfBrdfTable table(options);
    double largest = 0.0;
    for (const int level : {0, 3, 6, 10, 14, 20, 30}) {
        const double roughness = (level + 0.5) / 31.0;
        const auto projected = projectBrdf(test::makeGgx(roughness), options);
        largest =
            std::max(largest, largestDifference(table.specular(roughness).bright, projected[0]));
    }
    EXPECT_LT(largest, kInterpolation);
}

}  // namespace
}  // namespace prt
