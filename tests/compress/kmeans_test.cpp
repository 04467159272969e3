#include "prt/compress/kmeans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "prt/base/error.h"
#include "tests/support/sample_vectors.h"

namespace prt {
namespace {

constexpr double kErrorTolerance = 1e-6;  // of an error: floats of the stored numbers
constexpr double kRounding = 1e-5;        // of squared lengths: sums of floats

double distanceTo(const VectorSet& vectors, const KMeans& clusters, std::size_t vector,
                  std::size_t cluster) {
    const std::size_t d = vectors.dimension;
    return squaredDistance(vectors.numbers.subspan(vector * d, d),
                           combine(std::span(clusters.centroids).subspan(cluster * d, d), {}, {}),
                           vectors.errorWeights);
}

double measureError(const VectorSet& vectors, const KMeans& clusters) {
    double sum = 0.0;
    for (std::size_t i = 0; i < vectors.count(); ++i)
        sum += distanceTo(vectors, clusters, i, clusters.labels[i]);
    return sum;
}

/// Σ ‖x − mean‖² of the vectors i, i + step, …
double scatterOf(std::span<const float> numbers, std::size_t dimension, std::size_t first,
                 std::size_t step) {
    double scatter = 0.0;
    for (std::size_t j = 0; j < dimension; ++j) {
        double sum = 0.0, squares = 0.0, count = 0.0;
        for (std::size_t i = first * dimension + j; i < numbers.size(); i += step * dimension) {
            sum += numbers[i];
            squares += std::pow(double{numbers[i]}, 2);
            count += 1.0;
        }
        scatter += squares - sum * sum / count;
    }
    return scatter;
}

TEST(KMeans, EveryVectorHasTheNearestCentroid) {
    for (const std::size_t dimension : {1, 2, 9, 25}) {
        const std::vector<float> numbers = makeClouds({.count = 700, .dimension = dimension});
        const VectorSet vectors{numbers, dimension};
        const KMeans clusters = computeKMeans(vectors, {.clusterCount = 13});
        ASSERT_EQ(clusters.clusterCount(), 13u);
        const double squares = scatterOf(numbers, dimension, 0, 1) / 700.0;
        for (std::size_t i = 0; i < vectors.count(); ++i) {
            const double own = distanceTo(vectors, clusters, i, clusters.labels[i]);
            for (std::size_t k = 0; k < 13; ++k)
                ASSERT_LE(own, distanceTo(vectors, clusters, i, k) + kRounding * squares);
        }
        EXPECT_NEAR(clusters.squaredError, measureError(vectors, clusters),
                    kErrorTolerance * clusters.squaredError);
    }
}

TEST(KMeans, CloudsThatLieApartAreFound) {
    constexpr std::size_t kDimension = 7, kCloudCount = 9;
    const std::vector<float> numbers = makeClouds(
        {.count = 900, .dimension = kDimension, .cloudCount = kCloudCount, .spread = 1000.0});
    const KMeans clusters = computeKMeans({numbers, kDimension}, {.clusterCount = kCloudCount});
    double expected = 0.0;
    for (std::size_t cloud = 0; cloud < kCloudCount; ++cloud)
        expected += scatterOf(numbers, kDimension, cloud, kCloudCount);
    // The stored centroids are floats of numbers around 1000.
    EXPECT_NEAR(clusters.squaredError, expected, 1e-5 * expected);
    for (std::size_t i = 0; i < 900; ++i)
        EXPECT_EQ(clusters.labels[i], clusters.labels[i % kCloudCount]);
}

TEST(KMeans, TheErrorNeverRisesWithIterations) {
    const std::vector<float> numbers =
        makeClouds({.count = 3000, .dimension = 5, .cloudCount = 40, .spread = 1.0, .noise = 1.0});
    double last = 1e30;
    for (std::size_t count = 0; count < 12; ++count) {
        const KMeans clusters =
            computeKMeans({numbers, 5}, {.clusterCount = 20, .iterationCount = count});
        EXPECT_LE(clusters.squaredError, last);
        last = clusters.squaredError;
    }
    EXPECT_LT(
        last,
        0.95 * computeKMeans({numbers, 5}, {.clusterCount = 20, .iterationCount = 0}).squaredError);
}

TEST(KMeans, ConvergedCentroidsAreTheMeansOfTheirVectors) {
    const std::vector<float> numbers = makeClouds({.count = 400, .dimension = 3});
    const KMeans clusters =
        computeKMeans({numbers, 3}, {.clusterCount = 5, .iterationCount = 1000});
    for (std::size_t k = 0; k < 5; ++k) {
        std::vector<double> sum(3, 0.0);
        double count = 0.0;
        for (std::size_t i = 0; i < 400; ++i) {
            if (clusters.labels[i] != k) continue;
            count += 1.0;
            for (std::size_t j = 0; j < 3; ++j)
                sum[j] += numbers[i * 3 + j];
        }
        for (std::size_t j = 0; j < 3; ++j)
            EXPECT_NEAR(clusters.centroids[k * 3 + j], sum[j] / count, 1e-5);
    }
}

TEST(KMeans, OneClusterIsTheMean) {
    const std::vector<float> numbers = makeClouds({.count = 500, .dimension = 4});
    const KMeans clusters = computeKMeans({numbers, 4}, {.clusterCount = 1});
    const double expected = scatterOf(numbers, 4, 0, 1);
    EXPECT_NEAR(clusters.squaredError, expected, kErrorTolerance * expected);
}

TEST(KMeans, FewDifferentVectorsAreReproducedByAsManyClusters) {
    std::vector<float> numbers;
    for (std::size_t i = 0; i < 600; ++i)
        numbers.insert(numbers.end(), {i % 3 == 0 ? 0.25f : 4.0f, i % 2 == 0 ? -1.0f : 7.5f});
    const KMeans clusters = computeKMeans({numbers, 2}, {.clusterCount = 50});
    EXPECT_EQ(clusters.clusterCount(), 4u);
    EXPECT_EQ(clusters.squaredError, 0.0);
}

TEST(KMeans, NoMoreClustersThanVectors) {
    const std::vector<float> numbers = makeClouds({.count = 6, .dimension = 5});
    const VectorSet vectors{numbers, 5};
    const KMeans clusters = computeKMeans(vectors, {.clusterCount = 256});
    EXPECT_EQ(clusters.clusterCount(), 6u);
    EXPECT_EQ(std::set(clusters.labels.begin(), clusters.labels.end()).size(), 6u);
    EXPECT_LE(clusters.squaredError, 1e-12 * scatterOf(numbers, 5, 0, 1));

    const KMeans one = computeKMeans({std::span(numbers).first(5), 5}, {});
    EXPECT_EQ(one.centroids, std::vector<float>(numbers.begin(), numbers.begin() + 5));
    EXPECT_EQ(one.squaredError, 0.0);
}

TEST(KMeans, AClusterThatLosesItsVectorsStartsAnew) {
    // Seeds come from 4096 of many vectors, of which almost all are the same: the few others are
    // reached by clusters that were left empty.
    constexpr std::size_t kCount = 200000;
    std::vector<float> numbers(kCount, 1.0f);
    for (std::size_t i = 0; i < 7; ++i)
        numbers[1000 + 20011 * i] = 10.0f + static_cast<float>(i * i);
    const KMeans clusters = computeKMeans({numbers, 1}, {.clusterCount = 8, .iterationCount = 30});
    EXPECT_EQ(clusters.squaredError, 0.0);
    EXPECT_EQ(clusters.clusterCount(), 8u);
}

TEST(KMeans, WeightsOfTheErrorActAsIfTheNumbersWereMultipliedByThem) {
    const std::vector<float> numbers = makeClouds({.count = 500, .dimension = 3});
    const std::vector<float> weights = {4.0f, 0.5f, 0.0625f};
    std::vector<float> scaled = numbers;
    for (std::size_t i = 0; i < scaled.size(); ++i)
        scaled[i] *= weights[i % 3];
    const VectorSet vectors{numbers, 3, weights};
    const KMeans clusters = computeKMeans(vectors, {.clusterCount = 10});
    const KMeans expected = computeKMeans({scaled, 3}, {.clusterCount = 10});
    EXPECT_EQ(clusters.labels, expected.labels);
    EXPECT_NEAR(clusters.squaredError, expected.squaredError,
                kErrorTolerance * expected.squaredError);
    EXPECT_NEAR(clusters.squaredError, measureError(vectors, clusters),
                kErrorTolerance * clusters.squaredError);
}

TEST(KMeans, TinyAndHugeNumbersGiveTheSameClusters) {
    const std::vector<float> numbers = makeClouds({.count = 400, .dimension = 4, .noise = 1.0});
    const KMeans clusters = computeKMeans({numbers, 4}, {.clusterCount = 9});
    for (const float scale : {0x1p-90f, 0x1p+70f}) {
        std::vector<float> scaled = numbers;
        for (float& number : scaled)
            number *= scale;
        EXPECT_EQ(computeKMeans({scaled, 4}, {.clusterCount = 9}).labels, clusters.labels);
    }
}

TEST(KMeans, APartOfTheVectorsIsEnoughToFindClouds) {
    const std::vector<float> numbers =
        makeClouds({.count = 20000, .dimension = 6, .cloudCount = 5, .spread = 100.0});
    const KMeans all = computeKMeans({numbers, 6}, {.clusterCount = 5});
    const KMeans part = computeKMeans({numbers, 6}, {.clusterCount = 5, .trainingCount = 1000});
    EXPECT_LT(part.squaredError, 1.02 * all.squaredError);
}

TEST(KMeans, TheNumberOfThreadsChangesNoBitAndTheSeedDoes) {
    const std::vector<float> numbers = makeClouds({.count = 30000, .dimension = 5, .noise = 1.0});
    const auto cluster = [&](std::uint64_t seed, int threadCount) {
        return computeKMeans(
            {numbers, 5},
            {.clusterCount = 30, .iterationCount = 5, .seed = seed, .threadCount = threadCount});
    };
    const KMeans one = cluster(1, 1), four = cluster(1, 4), other = cluster(2, 1);
    EXPECT_EQ(one.centroids, four.centroids);
    EXPECT_EQ(one.labels, four.labels);
    EXPECT_EQ(one.squaredError, four.squaredError);
    EXPECT_NE(one.centroids, other.centroids);
}

TEST(KMeans, IsCancelledByItsProgress) {
    const std::vector<float> numbers = makeClouds({});
    std::uint64_t done = 0;
    KMeansOptions options{.clusterCount = 4, .progress = [&](const Progress& progress) {
                              done = progress.done;
                              EXPECT_LE(progress.done, progress.total);
                              return true;
                          }};
    computeKMeans({numbers, 8}, options);
    EXPECT_EQ(done, options.iterationCount + 1);
    options.progress = [](const Progress&) { return false; };
    EXPECT_THROW(computeKMeans({numbers, 8}, options), Error);
}

}  // namespace
}  // namespace prt
