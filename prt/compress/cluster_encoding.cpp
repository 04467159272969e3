// Bibliography
//   [Sloan03]  Clustered principal components for precomputed radiance transfer
#include "prt/compress/cluster_encoding.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

#include "prt/base/assert.h"
#include "prt/compress/quantise_table.h"
#include "prt/compress/subspace_kernel.h"
#include "prt/compress/table_rows.h"
#include "prt/compress/weighted_vectors.h"
#include "prt/parallel/parallel_for.h"

namespace prt {
namespace {

constexpr std::size_t kRowsAtOnce = 1024;

double errorWeight(std::span<const float> errorWeights, std::size_t j) {
    return errorWeights.empty() ? 1.0 : double{errorWeights[j]};
}

/// Linear maps from rows to weights, one a cluster:  t = P (x − origin).
struct WeightFinder {
    std::size_t dimension = 0;
    std::vector<float> origins;             ///< [cluster][dimension]
    std::vector<double> maps;               ///< Pᵀ: [dimension][component] of each cluster
    std::vector<std::size_t> firstWeights;  ///< [cluster + 1]

    std::size_t weightCount(std::size_t cluster) const {
        return firstWeights[cluster + 1] - firstWeights[cluster];
    }

    /// @param weights  as many as the cluster has, written
    void findWeights(std::span<const float> row, std::size_t cluster,
                     std::span<double> weights) const {
        std::ranges::fill(weights, 0.0);
        const double* map = maps.data() + firstWeights[cluster] * dimension;
        const float* origin = origins.data() + cluster * dimension;
        for (std::size_t j = 0; j < dimension; ++j) {
            const double offset = double{row[j]} - origin[j];
            for (double& weight : weights)
                weight += *map++ * offset;
        }
    }
};

/// Calls body(firstRow, rows) for a thousand rows at a time, on several threads.
template <class Body>
void forEachBatch(const RowEncoding& encoding, Body body) {
    const std::size_t rowLength = encoding.numbers.columnCount();
    parallelFor(encoding.numbers.rowCount(), {encoding.threadCount, kRowsAtOnce},
                [&](std::size_t begin, std::size_t end) {
                    std::vector<float> rows((end - begin) * rowLength);
                    readRows(encoding.numbers, begin, end - begin, rows);
                    body(begin, std::span<const float>(rows));
                    encoding.reporter.advance(end - begin);
                });
    encoding.numbers.releaseMemory();
}

/// Components are orthonormal under the weights of errors, so the weights are products.
WeightFinder makeProjection(const Clusters& clusters, std::span<const float> errorWeights) {
    WeightFinder finder{clusters.dimension, clusters.means, {}, clusters.firstComponent};
    for (std::size_t k = 0; k < clusters.count(); ++k)
        for (std::size_t j = 0; j < clusters.dimension; ++j)
            for (std::size_t p = clusters.firstComponent[k]; p < clusters.firstComponent[k + 1];
                 ++p) {
                const double weight = errorWeight(errorWeights, j);
                finder.maps.push_back(weight * weight *
                                      clusters.components[p * clusters.dimension + j]);
            }
    return finder;
}

/// The weights of least squared error for vectors as they are stored, which are no longer quite
/// orthogonal, and may have become the same or nothing.
WeightFinder makeLeastSquares(const ClusterBases& bases, std::span<const float> errorWeights) {
    const std::vector<float> vectors = expandTable(bases.vectors);
    const std::vector<std::size_t> firstVectors = bases.firstVectors();
    const std::size_t dimension = bases.vectors.numbers.columnCount();
    WeightFinder finder{dimension, {}, {}, {0}};
    for (std::size_t k = 0; k < bases.clusterCount(); ++k) {
        const float* vector = vectors.data() + firstVectors[k] * dimension;
        finder.origins.insert(finder.origins.end(), vector, vector + dimension);
        const std::size_t count = bases.componentCounts[k];
        finder.firstWeights.push_back(finder.firstWeights.back() + count);
        if (count == 0) continue;
        Eigen::MatrixXd weighted(dimension, count);
        for (std::size_t p = 0; p < count; ++p) {
            vector += dimension;
            for (std::size_t j = 0; j < dimension; ++j)
                weighted(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(p)) =
                    errorWeight(errorWeights, j) * vector[j];
        }
        const Eigen::MatrixXd inverse = weighted.completeOrthogonalDecomposition().pseudoInverse();
        for (std::size_t j = 0; j < dimension; ++j)
            for (std::size_t p = 0; p < count; ++p)
                finder.maps.push_back(
                    inverse(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(j)) *
                    errorWeight(errorWeights, j));
    }
    return finder;
}

/// Clusters in the space where the nearest is looked for.
std::vector<Subspace> weighClusters(const WeightedVectors& space, const Clusters& clusters) {
    const std::size_t dimension = clusters.dimension;
    std::vector<Subspace> subspaces;
    for (std::size_t k = 0; k < clusters.count(); ++k) {
        Subspace subspace{
            weighPoint(space, std::span(clusters.means).subspan(k * dimension, dimension))};
        for (std::size_t p = clusters.firstComponent[k]; p < clusters.firstComponent[k + 1]; ++p) {
            const std::vector<double> axis = weighDirection(
                space, std::span(clusters.components).subspan(p * dimension, dimension));
            subspace.axes.insert(subspace.axes.end(), axis.begin(), axis.end());
        }
        subspaces.push_back(std::move(subspace));
    }
    return subspaces;
}

/// Writes one stored row: the cluster, and fractions.
template <class Stored>
void storeRow(std::uint32_t cluster, std::span<const double> weights, double largest,
              std::span<Stored> row) {
    row[0] = static_cast<Stored>(cluster);
    for (std::size_t p = 0; p < weights.size(); ++p) {
        const double fraction = std::clamp(weights[p], 0.0, 1.0);
        row[p + 1] = std::is_integral_v<Stored> ? static_cast<Stored>(fraction * largest + 0.5)
                                                : static_cast<Stored>(fraction);
    }
}

template <class Stored>
void storeRows(const RowEncoding& encoding, std::span<const std::uint32_t> labels,
               const WeightFinder& finder, StoredTable& table) {
    const std::size_t dimension = finder.dimension;
    const std::size_t rowLength = table.numbers.columnCount();
    const double largest = largestStored(table.encoding);
    forEachBatch(encoding, [&](std::size_t firstRow, std::span<const float> rows) {
        const std::size_t count = rows.size() / dimension;
        std::vector<Stored> stored(count * rowLength, Stored{0});
        std::vector<double> weights(rowLength - 1);
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t k = labels[firstRow + i];
            const auto own = std::span(weights).first(finder.weightCount(k));
            finder.findWeights(rows.subspan(i * dimension, dimension), k, own);
            storeRow<Stored>(k, own, largest, std::span(stored).subspan(i * rowLength, rowLength));
        }
        table.numbers.writeRows(firstRow, std::span<const Stored>(stored));
    });
}

/// @param weights  of all rows, one after another
void widenRanges(std::span<const std::uint32_t> labels, std::span<const double> weights,
                 const Clusters& clusters, RowAssignment& assignment) {
    auto weight = weights.begin();
    for (const std::uint32_t k : labels) {
        ++assignment.counts[k];
        for (std::size_t p = clusters.firstComponent[k]; p < clusters.firstComponent[k + 1]; ++p) {
            assignment.low[p] = std::min(assignment.low[p], *weight);
            assignment.high[p] = std::max(assignment.high[p], *weight);
            ++weight;
        }
    }
}

}  // namespace

RowAssignment assignRows(const RowEncoding& encoding, const Clusters& clusters) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const std::size_t dimension = clusters.dimension;
    const std::size_t componentCount = clusters.firstComponent.back();
    const WeightedVectors space =
        weighVectors({clusters.means, dimension, encoding.errorWeights}, encoding.threadCount);
    const std::vector<Subspace> subspaces = weighClusters(space, clusters);
    const SubspaceRows candidates(subspaces, allIndices(subspaces.size()));
    const WeightFinder finder = makeProjection(clusters, encoding.errorWeights);
    RowAssignment assignment{std::vector<std::uint32_t>(encoding.numbers.rowCount()),
                             std::vector<std::size_t>(clusters.count(), 0),
                             std::vector<double>(componentCount, kInfinity),
                             std::vector<double>(componentCount, -kInfinity)};
    std::mutex merging;
    forEachBatch(encoding, [&](std::size_t firstRow, std::span<const float> rows) {
        const std::size_t count = rows.size() / dimension;
        WeightedVectors batch = space;
        batch.numbers = rows;
        std::vector<float> distances(count);
        const auto labels = std::span(assignment.labels).subspan(firstRow, count);
        findNearestSubspaces(batch, allIndices(count), candidates, false, {labels, distances});
        std::vector<double> weights;  // of all rows, one after another
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t begin = weights.size();
            weights.resize(begin + finder.weightCount(labels[i]));
            finder.findWeights(rows.subspan(i * dimension, dimension), labels[i],
                               std::span(weights).subspan(begin));
        }
        const std::lock_guard lock(merging);
        widenRanges(labels, weights, clusters, assignment);
    });
    return assignment;
}

ClusterBases foldRanges(const Clusters& clusters, TransferEncoding encoding,
                        RowAssignment& assignment) {
    const std::size_t dimension = clusters.dimension;
    ClusterBases bases;
    std::vector<float> vectors;
    std::vector<std::uint32_t> newLabels(clusters.count(), 0);
    for (std::size_t k = 0; k < clusters.count(); ++k) {
        if (assignment.counts[k] == 0) continue;
        newLabels[k] = static_cast<std::uint32_t>(bases.clusterCount());
        std::vector<double> start(&clusters.means[k * dimension],
                                  &clusters.means[k * dimension] + dimension);
        std::vector<float> components;
        for (std::size_t p = clusters.firstComponent[k]; p < clusters.firstComponent[k + 1]; ++p) {
            const double low = assignment.low[p], range = assignment.high[p] - low;
            const float* component = &clusters.components[p * dimension];
            for (std::size_t j = 0; j < dimension; ++j) {
                start[j] += low * component[j];
                if (range > 0.0) components.push_back(static_cast<float>(range * component[j]));
            }
        }
        for (const double number : start)
            vectors.push_back(static_cast<float>(number));
        vectors.insert(vectors.end(), components.begin(), components.end());
        bases.componentCounts.push_back(static_cast<std::uint32_t>(components.size() / dimension));
    }
    for (std::uint32_t& label : assignment.labels)
        label = newLabels[label];
    bases.vectors = quantiseTable(makeTable(dimension, vectors), encoding);
    return bases;
}

StoredTable encodeRows(const RowEncoding& encoding, std::span<const std::uint32_t> labels,
                       const ClusterBases& bases, TransferEncoding weightEncoding) {
    const WeightFinder finder = makeLeastSquares(bases, encoding.errorWeights);
    StoredTable table{.encoding = weightEncoding,
                      .numbers = CoefficientTable(
                          encoding.numbers.rowCount(), 1 + bases.componentCount(),
                          bytesPerCoefficient(weightEncoding), encoding.numbers.storage())};
    switch (weightEncoding) {
        case TransferEncoding::float32:
            storeRows<float>(encoding, labels, finder, table);
            break;
        case TransferEncoding::unorm16:
            storeRows<std::uint16_t>(encoding, labels, finder, table);
            break;
        case TransferEncoding::unorm8:
            storeRows<std::uint8_t>(encoding, labels, finder, table);
            break;
    }
    return table;
}

}  // namespace prt
