#include "prt/asset/check_asset.h"

#include <gtest/gtest.h>

#include <cstring>

namespace prt {
namespace {

constexpr float kWhiteMean = 0.28209479f;  // 1/√4π: white surroundings and a white surface

/// An asset of four vertices with two bands, all of them with the same transfer vector.
Asset assetWith(const std::vector<float>& vector) {
    Asset asset;
    asset.transfer.bandCount = 2;
    asset.transfer.receiverCount = 4;
    CompressedLayer layer;
    layer.table.numbers = CoefficientTable(4, vector.size(), sizeof(float));
    for (std::size_t vertex = 0; vertex < 4; ++vertex)
        layer.table.numbers.writeRows(vertex, std::span(vector));
    asset.transfer.layers = {layer};
    return asset;
}

void expectProblem(const std::vector<float>& vector, const std::string& part) {
    const std::vector<std::string> problems = findAssetProblems(assetWith(vector));
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_NE(problems[0].find(part), std::string::npos) << problems[0];
    EXPECT_NE(problems[0].find("4 of 4"), std::string::npos) << problems[0];
}

TEST(CheckAsset, AnOpenWhiteSurfaceIsSound) {
    // The unshadowed transfer of a surface that faces +z: T₁₀ = 2/3 · √(3/4π).
    EXPECT_TRUE(findAssetProblems(assetWith({kWhiteMean, 0.0f, 0.32573501f, 0.0f})).empty());
}

TEST(CheckAsset, MoreLightThanReflectancesUpToOneReturnIsDoubted) {
    expectProblem({kWhiteMean * 1.01f, 0.0f, 0.0f, 0.0f}, "more light");
    // Degree 1 is bounded by √(3/4π) = 0.4886.
    expectProblem({0.1f, 0.0f, -0.49f, 0.0f}, "more light");
    EXPECT_TRUE(findAssetProblems(assetWith({0.1f, 0.0f, -0.488f, 0.0f})).empty());
}

TEST(CheckAsset, NegativeRadianceIsDoubted) {
    const std::vector<std::string> problems =
        findAssetProblems(assetWith({-0.01f, 0.0f, 0.0f, 0.0f}));
    ASSERT_FALSE(problems.empty());
    EXPECT_NE(problems[0].find("negative"), std::string::npos);
}

TEST(CheckAsset, ManyUnlitVerticesAreDoubtedAndFewAreNot) {
    expectProblem({0.0f, 0.0f, 0.0f, 0.0f}, "no light");
    Asset asset = assetWith({0.2f, 0.0f, 0.1f, 0.0f});
    asset.transfer.layers[0].table.numbers.writeRows(0,
                                                     std::span<const float>(std::vector<float>(4)));
    EXPECT_TRUE(findAssetProblems(asset).empty());
}

TEST(CheckAsset, CoefficientsMayBeOffByTheErrorThatTheLayerNames) {
    for (const float excess : {0.009f, 0.011f})
        for (const std::vector<float>& vector :
             {std::vector<float>{kWhiteMean + excess, 0.0f, 0.0f, 0.0f},
              std::vector<float>{0.2f, 0.0f, 0.4886f + excess, 0.0f},
              std::vector<float>{-excess, 0.0f, 0.0f, 0.0f}}) {
            Asset asset = assetWith(vector);
            const std::vector<std::string> before = findAssetProblems(asset);
            EXPECT_FALSE(before.empty());
            asset.transfer.layers[0].largestError = 0.01f;
            // A vertex without light is dark, whatever the error.
            const std::size_t always = vector[0] < 0.0f ? 1 : 0;
            EXPECT_EQ(findAssetProblems(asset).size(), always + (excess > 0.01f ? 1 : 0));
        }
}

}  // namespace
}  // namespace prt
