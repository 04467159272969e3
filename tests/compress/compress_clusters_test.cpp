#include "prt/compress/compress_clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "prt/base/error.h"
#include "prt/compress/cluster_encoding.h"
#include "prt/compress/compress_transfer.h"
#include "tests/support/sample_vectors.h"
#include "tests/support/scatter_matrix.h"

namespace prt {
namespace {

constexpr double kErrorTolerance = 1e-4;  // of an error: floats of the stored numbers (A21)
// What rounding to floats may leave of numbers of this size: bases and fractions each once.
constexpr double kFloatNoise = 4.0 * std::numeric_limits<float>::epsilon();

constexpr TransferEncoding kFloat = TransferEncoding::float32;
constexpr TransferEncoding kWords = TransferEncoding::unorm16;
constexpr TransferEncoding kBytes = TransferEncoding::unorm8;

constexpr std::size_t kCloudCount = 20, kCloudDimension = 3;
constexpr double kNoise = 0.2;

/// Rows in clouds; by default these lie into one another, so that no cluster is obvious.
std::vector<float> makeRows(std::size_t count, std::size_t dimension, double spread = 1.0) {
    return makeClouds({.count = count,
                       .dimension = dimension,
                       .cloudCount = kCloudCount,
                       .subspaceDimension = kCloudDimension,
                       .spread = spread,
                       .noise = kNoise});
}

ClusterOptions floatBases(std::size_t clusterCount, std::size_t componentCount) {
    return {
        .clusterCount = clusterCount, .componentCount = componentCount, .basesEncoding = kFloat};
}

std::vector<float> expandClustered(const ClusteredTable& clustered) {
    return expandLayer({.table = clustered.table, .bases = clustered.bases});
}

/// Σ w_j² (x_j − x̂_j)² over all rows, of what reading back gives.
double measureError(const std::vector<float>& rows, const ClusteredTable& clustered,
                    const std::vector<float>& errorWeights = {}) {
    const std::vector<float> stored = expandClustered(clustered);
    EXPECT_EQ(stored.size(), rows.size());
    const std::size_t dimension = clustered.bases.vectors.numbers.columnCount();
    double sum = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double weight = errorWeights.empty() ? 1.0 : double{errorWeights[i % dimension]};
        sum += std::pow(weight * (double{stored[i]} - double{rows[i]}), 2.0);
    }
    return sum;
}

double sumSquares(const std::vector<float>& rows) {
    return std::inner_product(rows.begin(), rows.end(), rows.begin(), 0.0);
}

std::vector<std::uint32_t> clustersOf(const ClusteredTable& clustered) {
    std::vector<std::uint32_t> clusters(clustered.table.numbers.rowCount());
    readClusters({.table = clustered.table, .bases = clustered.bases}, 0, clusters);
    return clusters;
}

/// The least error of a row in a cluster, by Gram-Schmidt in double.
double leastError(std::span<const float> row, const ClusteredTable& clustered,
                  std::size_t cluster) {
    const std::size_t dimension = row.size();
    const std::vector<float> vectors = expandTable(clustered.bases.vectors);
    const float* base = &vectors[clustered.bases.firstVectors()[cluster] * dimension];
    std::vector<double> rest(dimension);
    for (std::size_t j = 0; j < dimension; ++j)
        rest[j] = double{row[j]} - base[j];
    const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
        return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    };
    const auto removeAxis = [&](std::vector<double>& from, const std::vector<double>& axis) {
        const double amount = dot(from, axis);
        for (std::size_t j = 0; j < dimension; ++j)
            from[j] -= amount * axis[j];
    };
    std::vector<std::vector<double>> axes;
    for (std::size_t p = 1; p <= clustered.bases.componentCounts[cluster]; ++p) {
        std::vector<double> axis(base + p * dimension, base + (p + 1) * dimension);
        for (const std::vector<double>& other : axes)
            removeAxis(axis, other);
        const double length = std::sqrt(dot(axis, axis));
        for (double& number : axis)
            number /= length;
        removeAxis(rest, axis);
        axes.push_back(axis);
    }
    return dot(rest, rest);
}

// A21: of one cluster, the squared error is the sum of the eigenvalues that are left out.
TEST(CompressClusters, OneClusterLeavesTheDiscardedEigenvalues) {
    constexpr std::size_t kDimension = 9;
    const std::vector<float> rows = makeRows(500, kDimension);
    std::vector<float> errorWeights;
    for (std::size_t j = 0; j < kDimension; ++j)
        errorWeights.push_back(1.0f / static_cast<float>(1 + j));
    for (const std::vector<float>& weights : {std::vector<float>{}, errorWeights}) {
        const std::vector<double> eigenvalues =
            jacobiEigenvalues(scatterMatrix({rows, kDimension, weights}));
        for (std::size_t count = 0; count < kDimension; ++count) {
            const ClusteredTable clustered = compressClusters(makeTable(kDimension, rows), weights,
                                                              floatBases(1, count), kFloat);
            EXPECT_EQ(clustered.bases.componentCount(), count);
            const double discarded = std::accumulate(
                eigenvalues.begin() + static_cast<std::ptrdiff_t>(count), eigenvalues.end(), 0.0);
            EXPECT_NEAR(measureError(rows, clustered, weights), discarded,
                        kErrorTolerance * discarded)
                << count << " components";
        }
    }
}

TEST(CompressClusters, AllComponentsLeaveNothingButRounding) {
    constexpr std::size_t kDimension = 8;
    const std::vector<float> rows = makeRows(300, kDimension);
    const double largest = std::abs(*std::ranges::max_element(
        rows, [](float a, float b) { return std::abs(a) < std::abs(b); }));
    for (const std::size_t clusterCount : {1, 7}) {
        const ClusteredTable clustered = compressClusters(
            makeTable(kDimension, rows), {}, floatBases(clusterCount, kDimension), kFloat);
        const double rms =
            std::sqrt(measureError(rows, clustered) / static_cast<double>(rows.size()));
        EXPECT_LE(rms, kFloatNoise * largest * (1.0 + kDimension));
    }
}

TEST(CompressClusters, MoreComponentsNeverRaiseTheError) {
    constexpr std::size_t kDimension = 16;
    const std::vector<float> rows = makeRows(2000, kDimension);
    for (const std::size_t clusterCount : {1, 8}) {
        double last = std::numeric_limits<double>::infinity();
        for (std::size_t count = 0; count <= kDimension; count += 2) {
            const double error =
                measureError(rows, compressClusters(makeTable(kDimension, rows), {},
                                                    floatBases(clusterCount, count), kFloat));
            EXPECT_LE(error, last + kFloatNoise * sumSquares(rows));
            last = error;
        }
    }
}

TEST(CompressClusters, EachRowIsInTheClusterThatReproducesItBest) {
    constexpr std::size_t kDimension = 10, kRowCount = 300;
    const std::vector<float> rows = makeRows(kRowCount, kDimension);
    for (const std::size_t componentCount : {0, 2}) {
        const ClusteredTable clustered = compressClusters(makeTable(kDimension, rows), {},
                                                          floatBases(12, componentCount), kFloat);
        ASSERT_EQ(clustered.bases.clusterCount(), 12u);
        const std::vector<std::uint32_t> clusters = clustersOf(clustered);
        for (std::size_t i = 0; i < kRowCount; ++i) {
            const auto row = std::span(rows).subspan(i * kDimension, kDimension);
            const double own = leastError(row, clustered, clusters[i]);
            for (std::size_t k = 0; k < clustered.bases.clusterCount(); ++k)
                EXPECT_LE(own, leastError(row, clustered, k) + 1e-5);  // floats of the search
        }
    }
}

TEST(CompressClusters, TheWeightsOfEachComponentReachFromZeroToOne) {
    constexpr std::size_t kDimension = 10;
    const std::vector<float> rows = makeRows(1000, kDimension);
    const ClusteredTable clustered =
        compressClusters(makeTable(kDimension, rows), {}, floatBases(6, 3), kWords);
    const std::vector<std::uint32_t> clusters = clustersOf(clustered);
    const auto stored = copyRows<std::uint16_t>(clustered.table.numbers);
    for (std::size_t k = 0; k < clustered.bases.clusterCount(); ++k)
        for (std::size_t p = 1; p <= clustered.bases.componentCounts[k]; ++p) {
            int low = 65535, high = 0;
            for (std::size_t i = 0; i < clusters.size(); ++i) {
                if (clusters[i] != k) continue;
                low = std::min<int>(low, stored[i * 4 + p]);
                high = std::max<int>(high, stored[i * 4 + p]);
            }
            EXPECT_LE(low, 1);
            EXPECT_GE(high, 65534);
        }
}

/// T-21 for weights: components are orthogonal, so the squared error of a row is that of its best
/// weights, and at most the square of half a step of each component.
void expectWeightsWithinHalfAStep(TransferEncoding encoding) {
    constexpr double kSlack = 1e-5;  // floats of the numbers read back, against what is left
    constexpr std::size_t kDimension = 12;
    const std::vector<float> rows = makeRows(800, kDimension);
    const ClusteredTable clustered =
        compressClusters(makeTable(kDimension, rows), {}, floatBases(5, 4), encoding);
    const std::vector<std::uint32_t> clusters = clustersOf(clustered);
    const std::vector<float> vectors = expandTable(clustered.bases.vectors);
    const std::vector<std::size_t> firstVectors = clustered.bases.firstVectors();
    const std::vector<float> stored = expandClustered(clustered);
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        const auto row = std::span(rows).subspan(i * kDimension, kDimension);
        const double least = leastError(row, clustered, clusters[i]);
        double bound = least;
        for (std::size_t v = firstVectors[clusters[i]] + 1; v < firstVectors[clusters[i] + 1];
             ++v) {
            const auto component = std::span(vectors).subspan(v * kDimension, kDimension);
            const double halfStep = 0.5 / largestStored(encoding);
            bound += halfStep * halfStep * weightedDot(component, component);
        }
        const std::vector<double> back(&stored[i * kDimension],
                                       &stored[i * kDimension] + kDimension);
        EXPECT_LE(squaredDistance(row, back), bound + kSlack * least);
    }
}

TEST(CompressClusters, WeightsOfWordsAreWithinHalfAStep) {
    expectWeightsWithinHalfAStep(kWords);
}

TEST(CompressClusters, WeightsOfBytesAreWithinHalfAStep) {
    expectWeightsWithinHalfAStep(kBytes);
}

TEST(CompressClusters, WeightsMakeUpForTheRoundingOfTheBases) {
    constexpr std::size_t kDimension = 12;
    const std::vector<float> rows = makeRows(2000, kDimension);
    ClusterOptions options = floatBases(8, 6);
    const CoefficientTable table = makeTable(kDimension, rows);
    const double exact = measureError(rows, compressClusters(table, {}, options, kFloat));
    options.basesEncoding = kWords;
    EXPECT_LE(measureError(rows, compressClusters(table, {}, options, kFloat)), 1.0001 * exact);
    EXPECT_LE(measureError(rows, compressClusters(table, {}, options, kWords)), 1.0002 * exact);

    // Bases of eight bits are no longer orthogonal, and still no weights are better.
    options.basesEncoding = kBytes;
    const ClusteredTable coarse = compressClusters(table, {}, options, kFloat);
    const std::vector<std::uint32_t> clusters = clustersOf(coarse);
    const std::vector<float> stored = expandClustered(coarse);
    const std::vector<float> weights = expandTable(coarse.table);
    std::size_t checkedCount = 0;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        const auto own = std::span(weights).subspan(i * 7 + 1, 6);
        if (!std::ranges::all_of(own, [](float w) { return w > 0.0f && w < 1.0f; })) continue;
        const auto row = std::span(rows).subspan(i * kDimension, kDimension);
        const std::vector<double> back(&stored[i * kDimension],
                                       &stored[i * kDimension] + kDimension);
        const double least = leastError(row, coarse, clusters[i]);
        EXPECT_LE(squaredDistance(row, back), least + 1e-6 * (1.0 + least));
        ++checkedCount;
    }
    EXPECT_GT(checkedCount, clusters.size() / 2);
}

TEST(CompressClusters, ThreadsAndTheDiskDoNotChangeAByte) {
    constexpr std::size_t kDimension = 10;
    const std::vector<float> rows = makeRows(5000, kDimension);
    const CoefficientTable table = makeTable(kDimension, rows);
    CoefficientTable onDisk(5000, kDimension, sizeof(float), {.onDisk = true});
    onDisk.writeRows(0, std::span(rows));
    for (const std::size_t trainingCount : {0, 1000}) {
        ClusterOptions options{.clusterCount = 20, .componentCount = 3};
        options.trainingCount = trainingCount;
        const ClusteredTable one = compressClusters(table, {}, options, kBytes, 1);
        for (const ClusteredTable& other : {compressClusters(table, {}, options, kBytes, 3),
                                            compressClusters(onDisk, {}, options, kBytes, 2)}) {
            EXPECT_TRUE(one.table.numbers == other.table.numbers);
            EXPECT_EQ(one.bases.componentCounts, other.bases.componentCounts);
            EXPECT_TRUE(one.bases.vectors.numbers == other.bases.vectors.numbers);
            EXPECT_EQ(one.bases.vectors.scale, other.bases.vectors.scale);
        }
    }
}

TEST(CompressClusters, APartOfTheRowsTrainsForAll) {
    constexpr std::size_t kDimension = 10;
    constexpr double kLittle = 1.3;  // times the error of training on all
    const std::vector<float> rows = makeRows(8000, kDimension, 10.0);
    const CoefficientTable table = makeTable(kDimension, rows);
    ClusterOptions options = floatBases(2 * kCloudCount, kCloudDimension);
    const double all = measureError(rows, compressClusters(table, {}, options, kFloat));
    options.trainingCount = 1600;
    const ClusteredTable clustered = compressClusters(table, {}, options, kFloat);
    EXPECT_EQ(clustered.table.numbers.rowCount(), 8000u);
    const double part = measureError(rows, clustered);
    EXPECT_GT(part, all);
    EXPECT_LT(part, kLittle * all);
}

TEST(CompressClusters, AMaxErrorIsKeptWithFewerVectors) {
    constexpr std::size_t kDimension = 16;
    const std::vector<float> rows = makeRows(2000, kDimension, 2.0);
    const CoefficientTable table = makeTable(kDimension, rows);
    ClusterOptions options = floatBases(kCloudCount, 8);
    const std::size_t vectorCount =
        compressClusters(table, {}, options, kFloat).bases.vectors.numbers.rowCount();
    for (const double maxError : {0.05, 0.1, 0.2}) {
        options.maxError = maxError;
        const ClusteredTable clustered = compressClusters(table, {}, options, kFloat);
        EXPECT_LE(std::sqrt(measureError(rows, clustered) / sumSquares(rows)),
                  maxError * (1.0 + kErrorTolerance));
        EXPECT_LT(clustered.bases.vectors.numbers.rowCount(), vectorCount);
    }
}

TEST(CompressClusters, ClustersAndComponentsThatNoRowNeedsAreLeftOut) {
    // No row is near the second mean, and those near the third are all there.
    const CoefficientTable table = makeTable(2, std::vector<float>{1, 0, 2, 0, 3, 0, 9, 5, 9, 5});
    const Clusters clusters{.dimension = 2,
                            .means = {2, 0, 50, 0, 9, 5},
                            .components = {1, 0, 0, 1, 0, 1},
                            .firstComponent = {0, 1, 2, 3}};
    const ProgressCallback nobody;
    ProgressReporter reporter(nobody, "encode", "receivers", 10);
    const RowEncoding encoding{table, {}, 1, reporter};
    RowAssignment assignment = assignRows(encoding, clusters);
    EXPECT_EQ(assignment.counts, (std::vector<std::size_t>{3, 0, 2}));
    const ClusterBases bases = foldRanges(clusters, kFloat, assignment);
    EXPECT_EQ(assignment.labels, (std::vector<std::uint32_t>{0, 0, 0, 1, 1}));
    EXPECT_EQ(bases.componentCounts, (std::vector<std::uint32_t>{1, 0}));
    // From where the weights begin, and as long as they reach.
    EXPECT_EQ(expandTable(bases.vectors), (std::vector<float>{1, 0, 2, 0, 9, 5}));
}

TEST(CompressClusters, LongRowsOfTransferMatricesAreRowsLikeOthers) {
    for (const std::size_t dimension : {625, 1875}) {
        const std::vector<float> rows = makeRows(300, dimension, 10.0);
        const ClusteredTable clustered = compressClusters(
            makeTable(dimension, rows), {}, floatBases(2 * kCloudCount, kCloudDimension), kWords);
        EXPECT_LT(measureError(rows, clustered), kNoise * kNoise * double(rows.size()));
    }
}

TEST(CompressClusters, EightBitsNumberNoMoreThan256Clusters) {
    const std::vector<float> rows = makeRows(600, 4);
    try {
        compressClusters(makeTable(4, rows), {}, floatBases(257, 1), kBytes);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::invalidOption);
    }
    const ClusteredTable clustered =
        compressClusters(makeTable(4, rows), {}, floatBases(256, 0), kBytes);
    EXPECT_EQ(clustered.bases.clusterCount(), 256u);
    EXPECT_EQ(std::ranges::max(clustersOf(clustered)), 255u);
}

TEST(CompressClusters, ACallerCanStopIt) {
    const CoefficientTable table = makeTable(6, makeRows(3000, 6));
    for (const std::string_view stage : {"quantise", "cluster", "encode"}) {
        const ProgressCallback stopThere = [&](const Progress& progress) {
            return progress.stage != stage;
        };
        try {
            compressClusters(table, {}, {.clusterCount = 20, .componentCount = 2}, kBytes, 0,
                             stopThere);
            FAIL() << stage;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::cancelled);
        }
    }
}

/// One layer of transfer, mono or RGB, with three bands.
TransferField fieldOf(const std::vector<float>& rows, int channelCount) {
    const std::size_t rowLength = coefficientsPerReceiver(3, channelCount);
    TransferField field;
    field.bandCount = 3;
    field.receiverCount = rows.size() / rowLength;
    field.layers = {{Transport::shadowed, channelCount, makeTable(rowLength, rows)}};
    return field;
}

TEST(CompressTransferByClusters, FewAndEqualReceiversAreReproduced) {
    for (const int channelCount : {1, 3}) {
        const std::size_t rowLength = coefficientsPerReceiver(3, channelCount);
        const std::vector<float> drawn = makeRows(5, rowLength);
        const std::vector<float> one(drawn.begin(),
                                     drawn.begin() + static_cast<std::ptrdiff_t>(rowLength));
        std::vector<float> equal;
        for (int i = 0; i < 40; ++i)
            equal.insert(equal.end(), one.begin(), one.end());
        const double largest = 6.0;  // of |x|, and so of the range that is rounded
        for (const std::vector<float>& rows : {one, equal, drawn})
            for (const std::size_t clusterCount : {1, 8})
                for (const std::size_t componentCount : {0, 7})
                    for (const TransferEncoding encoding : {kFloat, kWords, kBytes}) {
                        if (&rows != &equal && clusterCount == 1 && rows.size() > rowLength)
                            continue;  // five rows in one cluster without components
                        CompressOptions options{.encoding = encoding};
                        options.clusters = {.clusterCount = clusterCount,
                                            .componentCount = componentCount,
                                            .basesEncoding = encoding};
                        const TransferField field = fieldOf(rows, channelCount);
                        const CompressedTransfer stored = compressTransfer(field, options);
                        EXPECT_TRUE(isComplete(stored, stored.layers[0]));
                        const std::vector<float> back = expandLayer(stored.layers[0]);
                        const double step =
                            encoding == kFloat ? kFloatNoise : 1.0 / largestStored(encoding);
                        for (std::size_t i = 0; i < rows.size(); ++i)
                            EXPECT_NEAR(back[i], rows[i], 2.0 * largest * step);
                    }
    }
}

TEST(CompressTransferByClusters, AllButTheNumbersIsKept) {
    TransferField field = fieldOf(makeRows(200, 27), 3);
    field.receiverOfVertex = {3, 1, 199};
    CompressOptions options{.encoding = kBytes};
    options.clusters = {.clusterCount = 16, .componentCount = 3};
    const CompressedTransfer stored = compressTransfer(field, options);
    EXPECT_EQ(stored.bandCount, 3);
    EXPECT_EQ(stored.receiverCount, 200u);
    EXPECT_EQ(stored.receiverOfVertex, field.receiverOfVertex);
    const CompressedLayer& layer = stored.layers.at(0);
    EXPECT_EQ(layer.transport, Transport::shadowed);
    EXPECT_EQ(layer.channelCount, 3);
    EXPECT_EQ(layer.table.encoding, kBytes);
    EXPECT_EQ(bytesPerReceiver(layer), 4u);
    EXPECT_EQ(countSharedBytes(layer), 2u * 27u * layer.bases->vectors.numbers.rowCount());
    EXPECT_TRUE(isComplete(stored, layer));
}

TEST(CompressTransferByClusters, NoReceiversAreNoClusters) {
    TransferField field;
    field.bandCount = 3;
    field.layers = {{Transport::unshadowed, 1, CoefficientTable(0, 9, sizeof(float))}};
    CompressOptions options;
    options.clusters.emplace();
    const CompressedTransfer stored = compressTransfer(field, options);
    EXPECT_FALSE(stored.layers[0].bases);
    EXPECT_TRUE(isComplete(stored, stored.layers[0]));
}

}  // namespace
}  // namespace prt
