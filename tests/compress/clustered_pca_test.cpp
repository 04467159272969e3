#include "prt/compress/clustered_pca.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "prt/base/error.h"
#include "prt/compress/kmeans.h"
#include "prt/compress/pca.h"
#include "tests/support/sample_vectors.h"

namespace prt {
namespace {

constexpr double kErrorTolerance = 1e-6;  // of an error: floats of the stored numbers
constexpr double kFloatNoise = 1e-12;     // of all squares: floats have 24 bits

std::span<const float> vectorOf(const VectorSet& vectors, std::size_t i) {
    return vectors.numbers.subspan(i * vectors.dimension, vectors.dimension);
}

std::span<const float> meanOf(const ClusteredPca& pca, std::size_t cluster) {
    return std::span(pca.means).subspan(cluster * pca.dimension, pca.dimension);
}

std::span<const float> componentsOf(const ClusteredPca& pca, std::size_t cluster) {
    return std::span(pca.components)
        .subspan(pca.firstComponent[cluster] * pca.dimension,
                 pca.componentCount(cluster) * pca.dimension);
}

/// From the stored numbers.
double measureError(const VectorSet& vectors, const ClusteredPca& pca) {
    double sum = 0.0;
    for (std::size_t i = 0; i < vectors.count(); ++i) {
        const std::size_t cluster = pca.labels[i];
        const auto weights =
            std::span(pca.weights).subspan(i * pca.weightStride, pca.componentCount(cluster));
        sum += squaredDistance(vectorOf(vectors, i),
                               combine(meanOf(pca, cluster), componentsOf(pca, cluster), weights),
                               vectors.errorWeights);
    }
    return sum;
}

/// The least error of a vector in a cluster.
double errorIn(const VectorSet& vectors, const ClusteredPca& pca, std::size_t vector,
               std::size_t cluster) {
    std::vector<float> offset(vectors.dimension);
    for (std::size_t j = 0; j < offset.size(); ++j)
        offset[j] = vectorOf(vectors, vector)[j] - meanOf(pca, cluster)[j];
    std::vector<float> weights;
    for (std::size_t p = 0; p < pca.componentCount(cluster); ++p)
        weights.push_back(static_cast<float>(weightedDot(
            offset, componentsOf(pca, cluster).subspan(p * pca.dimension, pca.dimension),
            vectors.errorWeights)));
    return squaredDistance(vectorOf(vectors, vector),
                           combine(meanOf(pca, cluster), componentsOf(pca, cluster), weights),
                           vectors.errorWeights);
}

/// Σ ‖x − mean‖².
double scatterOf(const VectorSet& vectors) {
    return computePca(vectors, {.componentCount = 0}).squaredError;
}

/// Clouds that lie into one another, in no subspace.
std::vector<float> makeHardVectors(std::size_t count, std::size_t dimension) {
    return makeClouds({.count = count,
                       .dimension = dimension,
                       .cloudCount = 50,
                       .subspaceDimension = 3,
                       .spread = 1.0,
                       .noise = 0.2});
}

std::vector<float> selectVectors(const VectorSet& vectors, const std::vector<std::size_t>& chosen) {
    std::vector<float> numbers;
    for (const std::size_t i : chosen)
        numbers.insert(numbers.end(), vectorOf(vectors, i).begin(), vectorOf(vectors, i).end());
    return numbers;
}

double pcaError(const std::vector<float>& numbers, std::size_t dimension, std::size_t count) {
    return numbers.empty()
               ? 0.0
               : computePca({numbers, dimension}, {.componentCount = count}).squaredError;
}

TEST(ClusteredPca, VectorsInAsManySubspacesAreReproduced) {
    for (const auto& [cloudCount, dimension, subspaceDimension] :
         {std::array<std::size_t, 3>{6, 12, 3}, {20, 9, 2}, {4, 75, 8}, {3, 400, 5}}) {
        const std::vector<float> numbers = makeClouds({.count = 50 * cloudCount,
                                                       .dimension = dimension,
                                                       .cloudCount = cloudCount,
                                                       .subspaceDimension = subspaceDimension,
                                                       .spread = 30.0});
        const VectorSet vectors{numbers, dimension};
        const ClusteredPca pca = computeClusteredPca(
            vectors, {.clusterCount = cloudCount, .componentCount = subspaceDimension});
        EXPECT_EQ(pca.clusterCount(), cloudCount);
        EXPECT_LE(pca.squaredError, kFloatNoise * scatterOf(vectors));
        EXPECT_LE(measureError(vectors, pca), kFloatNoise * scatterOf(vectors));
        std::vector<float> expanded(dimension);
        for (std::size_t i = 0; i < vectors.count(); ++i) {
            expandVector(pca, i, expanded);
            for (std::size_t j = 0; j < dimension; ++j)
                ASSERT_NEAR(expanded[j], vectorOf(vectors, i)[j], 1e-4);
        }
    }
}

TEST(ClusteredPca, CrossingLinesAreToldApart) {
    // Centroids cannot: all four lines cross at the origin.
    std::vector<float> numbers;
    RandomStream random(5, 0);
    for (int i = 0; i < 800; ++i) {
        const double amount = drawNormal(random), angle = 0.1 + 0.7 * (i % 4);
        numbers.push_back(static_cast<float>(amount * std::cos(angle)));
        numbers.push_back(static_cast<float>(amount * std::sin(angle)));
        numbers.push_back(0.0f);
    }
    const VectorSet vectors{numbers, 3};
    const double start =
        computeClusteredPca(vectors, {.clusterCount = 12, .componentCount = 1, .iterationCount = 0})
            .squaredError;
    const double end =
        computeClusteredPca(vectors,
                            {.clusterCount = 12, .componentCount = 1, .iterationCount = 100})
            .squaredError;
    EXPECT_LT(end, 0.2 * start);
}

TEST(ClusteredPca, OneClusterIsPca) {
    const std::vector<float> numbers = makeHardVectors(400, 10);
    const std::vector<float> weights = {1.0f, 2.0f, 3.0f, 1.0f, 0.5f, 1.0f, 1.0f, 1.0f, 0.1f, 1.0f};
    const VectorSet vectors{numbers, 10, weights};
    const ClusteredPca one = computeClusteredPca(vectors, {.clusterCount = 1, .componentCount = 4});
    const Pca pca = computePca(vectors, {.componentCount = 4});
    EXPECT_NEAR(one.squaredError, pca.squaredError, kErrorTolerance * pca.squaredError);
    EXPECT_EQ(one.means, pca.mean);
    EXPECT_EQ(one.components, pca.components);
    EXPECT_EQ(one.weights, pca.weights);
}

TEST(ClusteredPca, WithoutComponentsItIsNoWorseThanKMeans) {
    const std::vector<float> numbers = makeHardVectors(1000, 6);
    const VectorSet vectors{numbers, 6};
    const double kMeans =
        computeKMeans(vectors, {.clusterCount = 30, .iterationCount = 10}).squaredError;
    const ClusteredPca pca =
        computeClusteredPca(vectors, {.clusterCount = 30, .componentCount = 0});
    EXPECT_LE(pca.squaredError, kMeans);
    EXPECT_EQ(pca.weightStride, 0u);
}

TEST(ClusteredPca, TheErrorIsThatOfTheStoredNumbers) {
    const std::vector<float> numbers = makeHardVectors(1500, 9);
    const std::vector<float> weights = {1.0f, 2.0f, 3.0f, 1.0f, 0.5f, 1.0f, 1.0f, 1.0f, 0.1f};
    for (const VectorSet& vectors : {VectorSet{numbers, 9}, VectorSet{numbers, 9, weights}}) {
        const ClusteredPca pca =
            computeClusteredPca(vectors, {.clusterCount = 25, .componentCount = 3});
        EXPECT_NEAR(pca.squaredError, measureError(vectors, pca),
                    kErrorTolerance * pca.squaredError);
        for (std::size_t k = 0; k < pca.clusterCount(); ++k) {
            for (std::size_t p = 0; p < pca.componentCount(k); ++p) {
                for (std::size_t q = 0; q <= p; ++q)
                    ASSERT_NEAR(
                        weightedDot(componentsOf(pca, k).subspan(p * 9, 9),
                                    componentsOf(pca, k).subspan(q * 9, 9), vectors.errorWeights),
                        p == q ? 1.0 : 0.0, 1e-6);
            }
        }
    }
}

TEST(ClusteredPca, TheErrorOfAClusterIsWhatItsLeftOutComponentsWouldExplain) {
    const std::vector<float> numbers = makeHardVectors(800, 7);
    const VectorSet vectors{numbers, 7};
    const ClusteredPca pca =
        computeClusteredPca(vectors, {.clusterCount = 10, .componentCount = 2});
    double sum = 0.0;
    for (std::size_t k = 0; k < pca.clusterCount(); ++k) {
        std::vector<std::size_t> members;
        for (std::size_t i = 0; i < 800; ++i) {
            if (pca.labels[i] == k) members.push_back(i);
        }
        const std::vector<float> own = selectVectors(vectors, members);
        const Pca all = computePca({own, 7}, {.componentCount = 7});
        for (std::size_t p = 2; p < all.squares.size(); ++p)
            sum += all.squares[p];

        // Two halves, each with the best components for itself, are no worse.
        const std::vector<std::size_t> front(
            members.begin(), members.begin() + static_cast<std::ptrdiff_t>(members.size() / 2));
        const std::vector<std::size_t> back(
            members.begin() + static_cast<std::ptrdiff_t>(members.size() / 2), members.end());
        EXPECT_LE(pcaError(selectVectors(vectors, front), 7, 2) +
                      pcaError(selectVectors(vectors, back), 7, 2),
                  pcaError(own, 7, 2));
    }
    EXPECT_NEAR(pca.squaredError, sum, kErrorTolerance * sum);
}

TEST(ClusteredPca, TheErrorNeverRisesWithIterations) {
    const std::vector<float> numbers = makeHardVectors(700, 8);
    for (const std::size_t clusterCount : {5, 40}) {  // 40: some searches are near
        double last = 1e30;
        double first = 0.0;
        for (std::size_t count = 0; count < 25; ++count) {
            const double error = computeClusteredPca({numbers, 8}, {.clusterCount = clusterCount,
                                                                    .componentCount = 2,
                                                                    .iterationCount = count})
                                     .squaredError;
            EXPECT_LE(error, last);
            if (count == 0) first = error;
            last = error;
        }
        EXPECT_LT(last, 0.9 * first);
    }
}

TEST(ClusteredPca, TheErrorNeverRisesWithComponents) {
    const std::vector<float> numbers = makeHardVectors(1000, 9);
    double last = 1e30;
    for (std::size_t count = 0; count <= 9; ++count) {
        const ClusteredPca pca = computeClusteredPca(
            {numbers, 9}, {.clusterCount = 20, .componentCount = count, .iterationCount = 0});
        EXPECT_LE(pca.squaredError, last);
        last = pca.squaredError;
    }
    EXPECT_LE(last, kFloatNoise * scatterOf({numbers, 9}));
}

TEST(ClusteredPca, InTheEndEveryVectorIsInTheClusterThatReproducesItBest) {
    constexpr double kRounding = 3e-6;  // of a vector's squares: the search is in floats
    const std::vector<float> numbers =
        makeClouds({.count = 5000, .dimension = 6, .cloudCount = 1, .subspaceDimension = 9});
    const VectorSet vectors{numbers, 6};
    const ClusteredPca pca = computeClusteredPca(
        vectors, {.clusterCount = 40, .componentCount = 2, .iterationCount = 1000});
    for (std::size_t i = 0; i < vectors.count(); ++i) {
        double squares = 0.0;
        for (const float number : vectorOf(vectors, i))
            squares += number * number;
        const double own = errorIn(vectors, pca, i, pca.labels[i]);
        for (std::size_t k = 0; k < pca.clusterCount(); ++k)
            ASSERT_LE(own, errorIn(vectors, pca, i, k) + kRounding * (squares + 1.0));
    }
}

TEST(ClusteredPca, MaxErrorIsKeptWithFewerWeights) {
    const std::vector<float> numbers = makeHardVectors(2000, 8);
    const VectorSet vectors{numbers, 8};
    const ClusteredPca full =
        computeClusteredPca(vectors, {.clusterCount = 20, .componentCount = 6});
    const double fullError = std::sqrt(full.squaredError / 16000.0);
    for (const double factor : {1.2, 2.0, 4.0}) {
        const ClusteredPca pca = computeClusteredPca(
            vectors, {.clusterCount = 20, .componentCount = 6, .maxError = factor * fullError});
        const double error = std::sqrt(pca.squaredError / 16000.0);
        EXPECT_LE(error, factor * fullError * (1.0 + kErrorTolerance));
        EXPECT_EQ(pca.labels, full.labels);
        EXPECT_LT(pca.components.size(), full.components.size());
        EXPECT_NEAR(pca.squaredError, measureError(vectors, pca),
                    kErrorTolerance * pca.squaredError);
    }
}

TEST(ClusteredPca, ABudgetOfWeightsIsKeptAndBetterSpentThanEvenly) {
    // Clouds of one dimension and of five.
    std::vector<float> numbers = makeClouds(
        {.count = 600, .dimension = 10, .cloudCount = 3, .subspaceDimension = 1, .spread = 50.0});
    const std::vector<float> others = makeClouds({.count = 600,
                                                  .dimension = 10,
                                                  .cloudCount = 3,
                                                  .subspaceDimension = 5,
                                                  .spread = 50.0,
                                                  .seed = 2});
    numbers.insert(numbers.end(), others.begin(), others.end());
    const VectorSet vectors{numbers, 10};
    const ClusteredPca even =
        computeClusteredPca(vectors, {.clusterCount = 6, .componentCount = 3});
    const ClusteredPca spent = computeClusteredPca(
        vectors, {.clusterCount = 6, .componentCount = 10, .averageComponentCount = 3.0});
    std::size_t weightCount = 0;
    for (const std::uint32_t label : spent.labels)
        weightCount += spent.componentCount(label);
    EXPECT_LE(weightCount, 3 * vectors.count());
    EXPECT_GT(even.squaredError, 1.0);
    EXPECT_LE(spent.squaredError, kFloatNoise * scatterOf(vectors));
}

TEST(ClusteredPca, ABudgetOfAsManyComponentsInEachClusterIsNoWorse) {
    // One cloud without structure, where most vectors change their cluster, and others.
    const std::vector<float> cloud =
        makeClouds({.count = 1000, .dimension = 8, .cloudCount = 1, .subspaceDimension = 12});
    const std::vector<float> others = makeHardVectors(1000, 8);
    for (const std::size_t iterationCount : {0, 1, 2, 5, 6, 7}) {
        const VectorSet vectors{iterationCount < 5 ? cloud : others, 8};
        const double even = computeClusteredPca(vectors, {.clusterCount = 20,
                                                          .componentCount = 2,
                                                          .iterationCount = iterationCount})
                                .squaredError;
        const double spent = computeClusteredPca(vectors, {.clusterCount = 20,
                                                           .componentCount = 8,
                                                           .averageComponentCount = 2.0,
                                                           .iterationCount = iterationCount})
                                 .squaredError;
        EXPECT_LE(spent, even);
    }
}

TEST(ClusteredPca, VectorsThatTheSeedsMissedGetTheEmptyClusters) {
    std::vector<float> numbers(200000, 1.0f);
    for (std::size_t i = 0; i < 7; ++i)
        numbers[1000 + 20011 * i] = 10.0f + static_cast<float>(i * i);
    const ClusteredPca pca = computeClusteredPca(
        {numbers, 1}, {.clusterCount = 8, .componentCount = 0, .iterationCount = 0});
    EXPECT_EQ(pca.clusterCount(), 8u);
    EXPECT_EQ(pca.squaredError, 0.0);
}

TEST(ClusteredPca, OneVectorEqualVectorsAndFewerVectorsThanClusters) {
    const std::vector<float> few = makeClouds({.count = 7, .dimension = 4});
    const ClusteredPca seven = computeClusteredPca({few, 4}, {.clusterCount = 64});
    EXPECT_EQ(seven.clusterCount(), 7u);
    EXPECT_LE(seven.squaredError, kFloatNoise * scatterOf({few, 4}));

    const ClusteredPca one = computeClusteredPca({std::span(few).first(4), 4}, {});
    EXPECT_EQ(one.clusterCount(), 1u);
    EXPECT_EQ(one.means, std::vector<float>(few.begin(), few.begin() + 4));
    EXPECT_EQ(one.squaredError, 0.0);

    const std::vector<float> equal(300, 0.7f);
    for (const std::size_t dimension : {1, 3}) {
        const ClusteredPca pca = computeClusteredPca({equal, dimension}, {.clusterCount = 5});
        EXPECT_EQ(pca.clusterCount(), 1u);
        EXPECT_EQ(pca.componentCount(0), 0u);
        EXPECT_EQ(pca.means, std::vector<float>(dimension, 0.7f));
        EXPECT_EQ(pca.squaredError, 0.0);
    }
}

TEST(ClusteredPca, NumbersStayFiniteForVectorsOfEverySize) {
    for (const float scale : {1e-30f, 1e-10f, 1e15f}) {
        for (const std::size_t dimension : {1, 2, 30}) {
            std::vector<float> numbers = makeHardVectors(200, dimension);
            std::fill(numbers.begin(),
                      numbers.begin() + static_cast<std::ptrdiff_t>(60 * dimension), 0.0f);
            for (float& number : numbers)
                number *= scale;
            const ClusteredPca pca = computeClusteredPca({numbers, dimension}, {.clusterCount = 9});
            for (const auto* list : {&pca.means, &pca.components, &pca.weights})
                EXPECT_TRUE(std::all_of(list->begin(), list->end(),
                                        [](float number) { return std::isfinite(number); }));
            EXPECT_EQ(std::set(pca.labels.begin(), pca.labels.end()).size(), pca.clusterCount());
            EXPECT_LE(pca.squaredError, scatterOf({numbers, dimension}));
        }
    }
}

TEST(ClusteredPca, TheNumberOfThreadsChangesNoBitAndTheSeedDoes) {
    const std::vector<float> numbers = makeHardVectors(12000, 6);
    const auto cluster = [&](std::uint64_t seed, int threadCount) {
        return computeClusteredPca({numbers, 6}, {.clusterCount = 24,
                                                  .componentCount = 2,
                                                  .iterationCount = 6,
                                                  .seed = seed,
                                                  .threadCount = threadCount});
    };
    const ClusteredPca one = cluster(1, 1), four = cluster(1, 4), other = cluster(2, 1);
    EXPECT_EQ(one.means, four.means);
    EXPECT_EQ(one.components, four.components);
    EXPECT_EQ(one.labels, four.labels);
    EXPECT_EQ(one.weights, four.weights);
    EXPECT_EQ(one.squaredError, four.squaredError);
    EXPECT_NE(one.means, other.means);
}

TEST(ClusteredPca, IsCancelledByItsProgress) {
    const std::vector<float> numbers = makeHardVectors(500, 5);
    ClusteredPcaOptions options{.clusterCount = 4, .progress = [](const Progress& progress) {
                                    return progress.stage != "cluster" || progress.done < 1;
                                }};
    EXPECT_THROW(computeClusteredPca({numbers, 5}, options), Error);
}

}  // namespace
}  // namespace prt
