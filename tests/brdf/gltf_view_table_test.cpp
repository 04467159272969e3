#include "prt/brdf/gltf_view_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "prt/brdf/brdf_matrix.h"
#include "tests/brdf/brdf_samples.h"

namespace prt {
namespace {

/// The same for the table and for what it is held against, so that it need not be fine.
constexpr LobeQuadratureOptions kCoarse{.polarNodeCount = 32, .azimuthNodeCount = 16};

TEST(GltfViewTable, HoldsEveryMaterialFromEveryView) {
    // Linear between 24 roughnesses and 24 angles, beside a largest coefficient of ½.
    constexpr double kInterpolation = 4e-3;
    const GltfViewTable table({.bandCount = 4,
                               .levelCount = 24,
                               .viewCount = 24,
                               .horizonWeight = 1.0,
                               .quadrature = kCoarse});
    RandomStream random(1, 0);
    double largest = 0.0;
    for (int i = 0; i < 40; ++i) {
        const Vec3f baseColor(random.nextUnitFloat(), random.nextUnitFloat(),
                              random.nextUnitFloat());
        const MetallicRoughness surface{.metallic = random.nextUnitFloat(),
                                        .roughness = 0.2f + 0.8f * random.nextUnitFloat()};
        const Vec3d view = test::drawUpward(random);
        std::vector<float> response(3 * 16, 1.0f);
        table.addResponse(baseColor, surface, Vec3f(view), response);
        const auto expected = projectBrdfView(makeGltfBrdf(baseColor, surface), view, 4, kCoarse);
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (std::size_t k = 0; k < 16; ++k) {
                const double value = static_cast<double>(response[16 * channel + k]) - 1.0;
                EXPECT_NEAR(value, expected[channel][k], kInterpolation)
                    << "roughness " << surface.roughness << ", cosine " << view.z << ", number "
                    << k;
                largest = std::max(largest, std::abs(value));
            }
    }
    EXPECT_GT(largest, 0.3) << "nothing that could differ";
}

TEST(GltfViewTable, TakesViewsBelowTheHorizonAsAtIt) {
    const GltfViewTable table(
        {.bandCount = 3, .levelCount = 2, .viewCount = 2, .quadrature = kCoarse});
    std::vector<float> below(27);
    std::vector<float> at(27);
    const MetallicRoughness surface{.metallic = 0.5f, .roughness = 1.0f};
    table.addResponse(Vec3f(0.5f), surface, Vec3f(0.48f, 0.64f, -0.6f), below);
    table.addResponse(Vec3f(0.5f), surface, Vec3f(0.6f, 0.8f, 0.0f), at);
    for (std::size_t i = 0; i < 27; ++i)
        EXPECT_NEAR(below[i], at[i], 1e-6f);
}

}  // namespace
}  // namespace prt
