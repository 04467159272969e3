#include "prt/asset/check_asset.h"

#include <gtest/gtest.h>

#include <cstring>

#include "prt/base/random.h"
#include "tests/support/transfer_matrix_checks.h"

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

/// The same of matrices that so many rays were averaged for.
Asset assetWithMatrix(Transport transport, const std::vector<float>& matrix, int sampleCount,
                      int bandCount = 2) {
    Asset asset = assetWith(matrix);
    asset.provenance.sampleCount = sampleCount;
    asset.transfer.bandCount = bandCount;
    asset.transfer.layers[0].transport = transport;
    asset.transfer.layers[0].incidentBandCount = bandCount;
    return asset;
}

constexpr int kManyRays = 1'000'000'000;  // so many that they add nothing to the bounds

/// One number in a matrix that is sound but for it.
Asset assetWithElement(Transport transport, std::size_t i, std::size_t j, float value,
                       int sampleCount = kManyRays) {
    std::vector<float> matrix(16);
    matrix[0] = 0.25f;
    matrix[i * 4 + j] = value;
    return assetWithMatrix(transport, matrix, sampleCount);
}

void expectDoubted(const Asset& asset, const std::string& part) {
    const std::vector<std::string> problems = findAssetProblems(asset);
    ASSERT_FALSE(problems.empty());
    EXPECT_NE(problems[0].find(part), std::string::npos) << problems[0];
}

TEST(CheckMatrices, NoVisibilityAndNoReflectionOfAllLightIsDoubted) {
    constexpr int kBandCount = 4;
    constexpr std::size_t kCount = 16;
    const Vec3f normal = Vec3f(0.3f, -0.5f, 0.8f).normalized();
    RandomStream random(11, 0);
    float largest = 0.0f;
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<float> shadowed(kCount * kCount), reflected(kCount * kCount);
        // Light comes straight, or from wherever the surface seen there takes it.
        std::vector<double> incident(kCount), light(kCount);
        for (const SphereNode& node : test::hemisphereQuadrature(normal, 2 * kBandCount)) {
            const bool isOpen = trial == 0 || random.nextUnitFloat() < 0.05f * float(trial);
            const Vec3d other = Vec3d(random.nextUnitFloat() - 0.5, random.nextUnitFloat() - 0.5,
                                      random.nextUnitFloat() - 0.5)
                                    .normalized();
            evaluateSh(test::intoLocalFrame(node.direction, normal), kBandCount, incident);
            evaluateSh(isOpen ? node.direction : other, kBandCount, light);
            for (std::size_t k = 0; k < kCount * kCount; ++k) {
                const double share = node.weight * incident[k / kCount] * light[k % kCount];
                shadowed[k] += isOpen ? static_cast<float>(share) : 0.0f;
                reflected[k] += static_cast<float>(share);
            }
        }
        for (const float element : shadowed)
            largest = std::max(largest, std::abs(element));
        EXPECT_TRUE(findAssetProblems(
                        assetWithMatrix(Transport::glossyShadowed, shadowed, kManyRays, kBandCount))
                        .empty());
        EXPECT_TRUE(
            findAssetProblems(assetWithMatrix(Transport::glossy, reflected, kManyRays, kBandCount))
                .empty());
    }
    EXPECT_NEAR(largest, 0.5f, 1e-5f);  // the bound is attained
}

TEST(CheckMatrices, ElementsBeyondWhatCanComeInAreDoubted) {
    for (const std::size_t i : {0, 1, 3})
        for (const std::size_t j : {0, 1, 3}) {
            EXPECT_TRUE(
                findAssetProblems(assetWithElement(Transport::glossyShadowed, i, j, 0.5f)).empty());
            expectDoubted(assetWithElement(Transport::glossyShadowed, i, j, 0.502f), "more light");
            // Twice ½ √(2l+1), l that of the light.
            const float bound = j == 0 ? 1.0f : 1.7320508f;
            EXPECT_TRUE(
                findAssetProblems(assetWithElement(Transport::glossy, i, j, bound)).empty());
            expectDoubted(assetWithElement(Transport::glossy, i, j, bound * 1.002f), "more light");
        }
    expectDoubted(assetWithElement(Transport::glossyShadowed, 1, 2, -0.502f), "more light");
}

TEST(CheckMatrices, FewRaysMayAddToElementsButNotToTheMean) {
    constexpr float kExcess = 0.1f;
    const auto isSound = [](std::size_t i, std::size_t j, int sampleCount) {
        return findAssetProblems(
                   assetWithElement(Transport::glossyShadowed, i, j, 0.5f + kExcess, sampleCount))
            .empty();
    };
    // Six deviations of ½ √3 / √N, and of ½ / √N where i or j is a constant.
    EXPECT_TRUE(isSound(3, 1, 2500));
    EXPECT_FALSE(isSound(3, 1, 2800));
    EXPECT_TRUE(isSound(0, 1, 850));
    EXPECT_FALSE(isSound(0, 1, 950));
    EXPECT_FALSE(isSound(0, 0, 16));
    EXPECT_TRUE(isSound(3, 1, 0));  // an asset that does not say how it was baked
}

TEST(CheckMatrices, ReceiversThatUniformLightDoesNotReachAreDoubted) {
    expectDoubted(assetWithElement(Transport::glossyShadowed, 0, 0, -0.01f), "negative");
    expectDoubted(assetWithElement(Transport::glossy, 0, 0, 0.0f), "no light");
    // Only the first number of each matrix is a mean.
    EXPECT_TRUE(
        findAssetProblems(assetWithElement(Transport::glossyShadowed, 1, 0, -0.4f)).empty());
}

TEST(CheckMatrices, EachChannelHasItsOwnMean) {
    Asset asset = assetWithElement(Transport::glossy, 1, 1, 0.25f);
    CompressedLayer& layer = asset.transfer.layers[0];
    layer.channelCount = 3;
    std::vector<float> row(48);
    row[0] = row[16] = row[32] = 0.25f;
    const auto problemsOf = [&](std::size_t column, float value) {
        std::vector<float> changed = row;
        changed[column] = value;
        layer.table.numbers = CoefficientTable(4, 48, sizeof(float));
        for (std::size_t vertex = 0; vertex < 4; ++vertex)
            layer.table.numbers.writeRows(vertex, std::span<const float>(changed));
        return findAssetProblems(asset).size();
    };
    EXPECT_EQ(problemsOf(32, -0.1f), 1u);
    EXPECT_EQ(problemsOf(36, -0.1f), 0u);
}

}  // namespace
}  // namespace prt
