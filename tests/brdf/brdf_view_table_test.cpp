#include "prt/brdf/brdf_view_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "prt/basis/sh.h"
#include "prt/brdf/brdf_matrix.h"
#include "prt/brdf/gltf_view_table.h"
#include "prt/brdf/view_angle.h"
#include "tests/brdf/brdf_samples.h"

namespace prt {
namespace {

/// The same for the table and for what it is held against, so that it need not be fine.
constexpr LobeQuadratureOptions kCoarse{.polarNodeCount = 32, .azimuthNodeCount = 16};
constexpr double kFloatRounding = 1e-6;

TEST(BrdfViewTable, HoldsEveryKindOfBrdfFromEveryView) {
    // Linear between 24 angles, beside largest coefficients of ⅓ to ½.
    constexpr double kInterpolation = 6e-3;
    RandomStream random(1, 0);
    for (const auto& [name, brdf] : test::makeAllKinds()) {
        const BrdfViewTable table(
            brdf, {.bandCount = 4, .viewCount = 24, .horizonWeight = 1.0, .quadrature = kCoarse});
        ASSERT_EQ(table.bandCount(), 4);
        double largest = 0.0;
        for (int i = 0; i < 8; ++i) {
            const Vec3d view = test::drawUpward(random);
            std::vector<float> response(3 * 16, 1.0f);
            table.addResponse(Vec3f(view), response);
            const auto expected = projectBrdfView(brdf, view, 4, kCoarse);
            for (std::size_t k = 0; k < response.size(); ++k) {
                const double value = static_cast<double>(response[k]) - 1.0;
                EXPECT_NEAR(value, expected[k / 16][k % 16], kInterpolation)
                    << name << ", cosine " << view.z << ", number " << k;
                largest = std::max(largest, std::abs(value));
            }
        }
        EXPECT_GT(largest, 0.15) << name << ": nothing that could differ";
    }
}

TEST(BrdfViewTable, IsWhatTheTableOfGltfMaterialsSaysOfOneOfThem) {
    const Vec3f baseColor(0.9f, 0.5f, 0.2f);
    const MetallicRoughness surface{.metallic = 0.25f, .roughness = 0.5f};
    const BrdfViewTable table(makeGltfBrdf(baseColor, surface),
                              {.bandCount = 5, .viewCount = 7, .quadrature = kCoarse});
    const GltfViewTable gltf(
        {.bandCount = 5, .levelCount = 3, .viewCount = 7, .quadrature = kCoarse});
    for (const Vec3f& view : {Vec3f(0.0f, 0.0f, 1.0f), Vec3f(0.48f, -0.64f, 0.6f),
                              Vec3f(-0.6f, 0.8f, 0.0f), Vec3f(0.48f, 0.64f, -0.6f)}) {
        std::vector<float> response(75), expected(75);
        table.addResponse(view, response);
        gltf.addResponse(baseColor, surface, view, expected);
        for (std::size_t k = 0; k < 75; ++k)
            EXPECT_NEAR(response[k], expected[k], kFloatRounding) << k;
    }
}

TEST(BrdfViewTable, OfAMeasuredBrdfThatIsNotMirrorSymmetricIsTheMeanOfBothImages) {
    // The mirror image of φ_d is 180° − φ_d. Seen along the normal all is at 0.
    const std::vector<float> mean(3 * MeasuredBrdf::kCellCount, 0.5f);
    std::vector<float> skewed = mean;
    for (std::size_t i = 0; i < skewed.size(); ++i) {
        const std::size_t azimuth = i % MeasuredBrdf::kAzimuthCount;
        if (azimuth >= 10 && azimuth < 80) skewed[i] = 0.9f;
        if (azimuth >= 100 && azimuth < 170) skewed[i] = 0.1f;
    }
    const auto respond = [](std::vector<float> values) {
        const Brdf brdf{.lobes = {MeasuredLobe{std::make_shared<MeasuredBrdf>(std::move(values))}}};
        const BrdfViewTable table(brdf, {.bandCount = 3, .viewCount = 4});
        std::vector<float> response(27);
        table.addResponse(Vec3f(0.48f, 0.36f, 0.8f), response);
        return response;
    };
    constexpr float kCells = 1e-3f;  // whose middles are no mirror images where they are cut off
    const std::vector<float> ofSkewed = respond(skewed), ofMean = respond(mean);
    for (std::size_t k = 0; k < 27; ++k)
        EXPECT_NEAR(ofSkewed[k], ofMean[k], kCells) << k;
    EXPECT_GT(ofMean[2], 0.5f);
}

TEST(BrdfViewTable, HasRowsOfTheViewsItWasMadeFor) {
    const Brdf brdf = test::makeGgx(0.6);
    const BrdfViewTable table(
        brdf, {.bandCount = 3, .viewCount = 9, .horizonWeight = 1.0, .quadrature = kCoarse});
    ASSERT_EQ(table.viewCount(), 9u);
    for (std::size_t view = 0; view < 9; ++view) {
        const Vec3d direction = tableView(view, 9);
        const auto expected = projectBrdfView(brdf, direction, 3, kCoarse);
        const TablePlace place = placeView(static_cast<float>(direction.z), 9);
        // The last one stands for the horizon, where lobes are not defined, from a little above.
        if (view < 8) {
            EXPECT_NEAR(static_cast<float>(place.first) + place.share, static_cast<float>(view),
                        1e-3f);
        }
        ASSERT_EQ(table.row(view).size(), 3 * uprightCount(3));
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (int l = 0; l < 3; ++l)
                for (int m = 0; m <= l; ++m)
                    EXPECT_NEAR(table.row(view)[6 * channel + uprightIndex(l, m)],
                                expected[channel][static_cast<std::size_t>(shIndex(l, m))],
                                kFloatRounding);
    }
}

}  // namespace
}  // namespace prt
