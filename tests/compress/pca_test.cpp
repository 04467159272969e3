#include "prt/compress/pca.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/support/sample_vectors.h"
#include "tests/support/scatter_matrix.h"

namespace prt {
namespace {

constexpr double kErrorTolerance = 1e-6;  // of an error: floats of the stored numbers
constexpr double kFloatNoise = 1e-12;     // of all squares: floats have 24 bits

double sumFrom(const std::vector<double>& values, std::size_t first) {
    return std::accumulate(
        values.begin() + static_cast<std::ptrdiff_t>(std::min(first, values.size())), values.end(),
        0.0);
}

double measureError(const VectorSet& vectors, const Pca& pca) {
    double sum = 0.0;
    const std::size_t d = vectors.dimension, count = pca.componentCount();
    for (std::size_t i = 0; i < vectors.count(); ++i)
        sum += squaredDistance(
            vectors.numbers.subspan(i * d, d),
            combine(pca.mean, pca.components, std::span(pca.weights).subspan(i * count, count)),
            vectors.errorWeights);
    return sum;
}

void expectOrthonormal(const Pca& pca, std::span<const float> errorWeights) {
    constexpr double kTolerance = 1e-6;  // components are floats
    const auto component = [&](std::size_t p) {
        return std::span(pca.components).subspan(p * pca.dimension, pca.dimension);
    };
    for (std::size_t p = 0; p < pca.componentCount(); ++p) {
        for (std::size_t q = 0; q <= p; ++q)
            EXPECT_NEAR(weightedDot(component(p), component(q), errorWeights), p == q ? 1.0 : 0.0,
                        kTolerance);
    }
}

/// All dimensions used, each direction by another amount.
std::vector<float> makeVectors(std::size_t count, std::size_t dimension) {
    return makeClouds({.count = count,
                       .dimension = dimension,
                       .cloudCount = 3,
                       .subspaceDimension = 4,
                       .spread = 1.0,
                       .noise = 0.3});
}

/// ± 0.98^i along the i-th axis, for the first `axisCount` axes: mean 0, and the squares along
/// them are 2 · 0.98^(2 i).
std::vector<float> makeCross(std::size_t axisCount, std::size_t dimension) {
    std::vector<float> vectors(2 * axisCount * dimension, 0.0f);
    for (std::size_t i = 0; i < axisCount; ++i) {
        const auto length = static_cast<float>(std::pow(0.98, static_cast<double>(i)));
        vectors[2 * i * dimension + i] = length;
        vectors[(2 * i + 1) * dimension + i] = -length;
    }
    return vectors;
}

TEST(Pca, TheSquaredErrorIsWhatTheLeftOutComponentsWouldExplain) {
    constexpr std::size_t kDimension = 11;
    const std::vector<float> numbers = makeVectors(500, kDimension);
    const VectorSet vectors{numbers, kDimension};
    const std::vector<double> values = jacobiEigenvalues(scatterMatrix(vectors));
    for (std::size_t count = 0; count < kDimension; ++count) {
        const Pca pca = computePca(vectors, {.componentCount = count});
        ASSERT_EQ(pca.componentCount(), count);
        EXPECT_NEAR(pca.totalSquares, sumFrom(values, 0), kErrorTolerance * pca.totalSquares);
        EXPECT_NEAR(pca.squaredError, sumFrom(values, count),
                    kErrorTolerance * sumFrom(values, count));
        EXPECT_NEAR(pca.squaredError, measureError(vectors, pca),
                    kErrorTolerance * pca.squaredError);
        for (std::size_t p = 0; p < count; ++p)
            EXPECT_NEAR(pca.squares[p], values[p], kErrorTolerance * values[p]);
    }
}

TEST(Pca, AllComponentsReproduceTheVectors) {
    for (const std::size_t dimension : {1, 2, 7, 8, 9, 25}) {
        const std::vector<float> numbers = makeVectors(300, dimension);
        const VectorSet vectors{numbers, dimension};
        const Pca pca = computePca(vectors, {.componentCount = dimension});
        EXPECT_LE(pca.squaredError, kFloatNoise * pca.totalSquares);
        std::vector<float> expanded(dimension);
        for (std::size_t i = 0; i < vectors.count(); ++i) {
            expandVector(pca, i, expanded);
            for (std::size_t j = 0; j < dimension; ++j)
                ASSERT_NEAR(expanded[j], numbers[i * dimension + j], 1e-5);
        }
    }
}

TEST(Pca, ComponentsAreOrthonormalAndWeightsAreSumsOverThem) {
    const std::vector<float> numbers = makeVectors(400, 13);
    const Pca pca = computePca({numbers, 13}, {.componentCount = 6});
    expectOrthonormal(pca, {});
    for (std::size_t p = 0; p < 6; ++p) {
        double squares = 0.0;
        for (std::size_t i = 0; i < 400; ++i)
            squares += std::pow(double{pca.weights[i * 6 + p]}, 2);
        EXPECT_NEAR(squares, pca.squares[p], kErrorTolerance * squares);
    }
}

TEST(Pca, WeightsOfTheErrorActAsIfTheNumbersWereMultipliedByThem) {
    constexpr std::size_t kDimension = 9;
    const std::vector<float> numbers = makeVectors(300, kDimension);
    const std::vector<float> weights = {3.0f, 1.0f, 0.25f, 8.0f, 1.0f, 0.01f, 2.0f, 1.0f, 1.5f};
    const VectorSet vectors{numbers, kDimension, weights};
    const std::vector<double> values = jacobiEigenvalues(scatterMatrix(vectors));
    for (const std::size_t count : {0, 2, 5}) {
        const Pca pca = computePca(vectors, {.componentCount = count});
        const double left = sumFrom(values, count);
        EXPECT_NEAR(pca.squaredError, left, kErrorTolerance * left);
        EXPECT_NEAR(measureError(vectors, pca), left, kErrorTolerance * left);
        expectOrthonormal(pca, weights);
    }
}

TEST(Pca, FewerVectorsThanDimensionsGiveTheSame) {
    constexpr std::size_t kDimension = 40, kCount = 17;
    const std::vector<float> numbers = makeVectors(kCount, kDimension);
    const VectorSet vectors{numbers, kDimension};
    const std::vector<double> values = jacobiEigenvalues(scatterMatrix(vectors));
    for (const std::size_t count : {1, 5, 12}) {
        const Pca pca = computePca(vectors, {.componentCount = count});
        const double left = sumFrom(values, count);
        EXPECT_NEAR(pca.squaredError, left, kErrorTolerance * left);
        expectOrthonormal(pca, {});
    }
    const Pca all = computePca(vectors, {.componentCount = kDimension});
    EXPECT_EQ(all.componentCount(), kCount - 1);
    EXPECT_LE(all.squaredError, kFloatNoise * all.totalSquares);
}

TEST(Pca, FewComponentsOfManyDimensionsAreFound) {
    // From dimensions, and from vectors.
    constexpr double kIterationTolerance = 1e-4;  // of the error
    for (const auto& [axisCount, dimension] :
         {std::pair<std::size_t, std::size_t>{320, 320}, {140, 400}}) {
        const std::vector<float> numbers = makeCross(axisCount, dimension);
        const Pca pca = computePca({numbers, dimension}, {.componentCount = 5});
        double total = 0.0, explained = 0.0;
        for (std::size_t i = 0; i < axisCount; ++i)
            total += 2.0 * std::pow(0.98, 2.0 * static_cast<double>(i));
        for (std::size_t p = 0; p < 5; ++p)
            explained += 2.0 * std::pow(0.98, 2.0 * static_cast<double>(p));
        ASSERT_EQ(pca.componentCount(), 5u);
        EXPECT_NEAR(pca.squaredError, total - explained, kIterationTolerance * (total - explained));
        expectOrthonormal(pca, {});
    }
}

TEST(Pca, AFarMeanCostsNoAccuracy) {
    constexpr std::size_t kDimension = 6;
    // Multiples of 2⁻¹⁰, so that adding 1024 is exact.
    std::vector<float> numbers = makeVectors(200, kDimension);
    for (float& number : numbers)
        number = std::round(number * 1024.0f) / 1024.0f;
    const Pca near = computePca({numbers, kDimension}, {.componentCount = 3});
    for (float& number : numbers)
        number += 1024.0f;
    const Pca far = computePca({numbers, kDimension}, {.componentCount = 3});
    EXPECT_NEAR(far.squaredError, near.squaredError, 1e-5 * near.squaredError);
}

TEST(Pca, TheFewestComponentsThatKeepAnErrorAreTaken) {
    constexpr std::size_t kDimension = 10;
    const std::vector<float> numbers = makeVectors(300, kDimension);
    const VectorSet vectors{numbers, kDimension};
    const std::vector<double> values = jacobiEigenvalues(scatterMatrix(vectors));
    for (std::size_t count = 1; count < kDimension; ++count) {
        const double squaredError = 0.5 * (sumFrom(values, count - 1) + sumFrom(values, count));
        const double maxError = std::sqrt(squaredError / static_cast<double>(numbers.size()));
        EXPECT_EQ(computePca(vectors, {.componentCount = kDimension, .maxError = maxError})
                      .componentCount(),
                  count);
    }
}

TEST(Pca, OneVectorAndEqualVectorsAreTheirMean) {
    for (const std::size_t count : {1, 2, 100}) {
        std::vector<float> numbers;
        for (std::size_t i = 0; i < count; ++i)
            numbers.insert(numbers.end(), {0.1f, -3.0f, 1e-20f, 7e8f});
        const Pca pca = computePca({numbers, 4}, {.componentCount = 3});
        EXPECT_EQ(pca.componentCount(), 0u);
        EXPECT_EQ(pca.mean, std::vector<float>(numbers.begin(), numbers.begin() + 4));
        EXPECT_EQ(pca.squaredError, 0.0);
        EXPECT_TRUE(pca.weights.empty());
    }
}

TEST(Pca, TinyAndHugeNumbersKeepTheirRelativeError) {
    constexpr std::size_t kDimension = 5;
    const std::vector<float> numbers = makeVectors(100, kDimension);
    const Pca pca = computePca({numbers, kDimension}, {.componentCount = 2});
    for (const float scale : {0x1p-90f, 0x1p+60f}) {
        std::vector<float> scaled = numbers;
        for (float& number : scaled)
            number *= scale;
        const Pca other = computePca({scaled, kDimension}, {.componentCount = 2});
        const double expected = pca.squaredError * scale * scale;
        EXPECT_NEAR(other.squaredError, expected, 1e-9 * expected);
    }
}

TEST(Pca, TheNumberOfThreadsChangesNoBit) {
    const std::vector<float> numbers = makeVectors(40000, 6);
    const Pca one = computePca({numbers, 6}, {.componentCount = 3, .threadCount = 1});
    const Pca four = computePca({numbers, 6}, {.componentCount = 3, .threadCount = 4});
    EXPECT_EQ(one.mean, four.mean);
    EXPECT_EQ(one.components, four.components);
    EXPECT_EQ(one.weights, four.weights);
    EXPECT_EQ(one.squaredError, four.squaredError);
}

}  // namespace
}  // namespace prt
