// Bibliography
//   [Sloan03]  Clustered principal components for precomputed radiance transfer
#include "prt/compress/clustered_pca.h"

#include <algorithm>
#include <cmath>

#include "prt/base/assert.h"
#include "prt/compress/encode_vectors.h"
#include "prt/compress/lloyd.h"
#include "prt/compress/principal_axes.h"
#include "prt/compress/reassignment.h"
#include "prt/parallel/parallel_for.h"

namespace prt {
namespace {

/// A copy of vectors in the order of their clusters at some time: members of a cluster are then
/// read one after another, which takes half the time of reading them from all over the memory.
struct SortedVectors {
    std::vector<float> numbers;
    std::vector<std::uint32_t> original;  ///< where each was
    WeightedVectors weighted;             ///< of the copy
};

/// @param original  all vectors, as they come
/// @param sorted    written
void sortVectors(const WeightedVectors& original, std::vector<std::uint32_t> order, int threadCount,
                 SortedVectors& sorted) {
    constexpr std::size_t kChunkSize = 16384;
    const std::size_t dimension = original.dimension;
    sorted.original = std::move(order);
    sorted.numbers.resize(original.numbers.size());
    parallelFor(original.count(), {threadCount, kChunkSize},
                [&](std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i)
                        std::copy_n(&original.numbers[sorted.original[i] * dimension], dimension,
                                    &sorted.numbers[i * dimension]);
                });
    sorted.weighted = original;
    sorted.weighted.numbers = sorted.numbers;
}

/// Puts rows of numbers back to where the vectors were.
template <class Number>
std::vector<Number> restoreOrder(std::span<const Number> rows, std::size_t length,
                                 std::span<const std::uint32_t> original) {
    std::vector<Number> restored(rows.size());
    for (std::size_t i = 0; i < original.size(); ++i)
        std::copy_n(rows.data() + i * length, length, restored.data() + original[i] * length);
    return restored;
}

/// Vectors in clusters, and the best subspace of each cluster.
struct Clustering {
    std::vector<std::uint32_t> labels;
    VectorGroups groups;
    std::vector<PrincipalAxes> axes;  ///< [cluster]
    double squaredError = 0.0;        ///< in the space of WeightedVectors
};

/// Fits subspaces to clusters; one without vectors keeps the subspace that it had.
Clustering fitClusters(const WeightedVectors& vectors, std::vector<std::uint32_t> labels,
                       std::span<const Subspace> subspaces, std::size_t axisCount,
                       int threadCount) {
    Clustering fitted;
    fitted.groups = groupByLabel(allIndices(vectors.count()), labels, subspaces.size());
    fitted.labels = std::move(labels);
    fitted.axes.resize(subspaces.size());
    const auto fit = [&](std::size_t k, int threads) {
        const auto members = fitted.groups.members(k);
        if (members.empty())
            fitted.axes[k].subspace = subspaces[k];
        else
            fitted.axes[k] = findPrincipalAxes(vectors, members, axisCount, threads);
    };
    if (subspaces.size() == 1)
        fit(0, threadCount);
    else
        parallelFor(subspaces.size(), {threadCount, 1},
                    [&](std::size_t k, std::size_t) { fit(k, 1); });
    for (const PrincipalAxes& axes : fitted.axes)
        fitted.squaredError += axes.squaredError(axisCount);
    return fitted;
}

std::vector<Subspace> listSubspaces(const Clustering& clustering) {
    std::vector<Subspace> subspaces;
    for (const PrincipalAxes& axes : clustering.axes)
        subspaces.push_back(axes.subspace);
    return subspaces;
}

/// Gives each cluster without vectors one that is far from its own subspace, which lowers the
/// error by all that it had.
void fillEmptyClusters(Assignment& assignment, std::size_t clusterCount) {
    std::vector<std::size_t> sizes(clusterCount, 0);
    for (const std::uint32_t label : assignment.labels)
        ++sizes[label];
    std::vector<std::uint32_t> empty;
    for (std::uint32_t k = 0; k < clusterCount; ++k) {
        if (sizes[k] == 0) empty.push_back(k);
    }
    const auto farthest = findFarthest(assignment.squaredDistances, empty.size());
    for (std::size_t i = 0; i < farthest.size(); ++i)
        assignment.labels[farthest[i]] = empty[i];
}

/// Starts with the clusters of k-means.
///
/// @param sorted  written: the vectors in the order of these clusters
Clustering startClusters(const WeightedVectors& vectors, std::size_t axisCount,
                         const ClusteredPcaOptions& options, SortedVectors& sorted) {
    constexpr std::size_t kTrainingPerCluster = 128;
    const std::size_t clusterCount = std::min(options.clusterCount, vectors.count());
    const std::vector<Subspace> centroids =
        trainCentroids(vectors, {.clusterCount = clusterCount,
                                 .iterationCount = 10,
                                 .trainingCount = kTrainingPerCluster * clusterCount,
                                 .seed = options.seed,
                                 .threadCount = options.threadCount,
                                 .progress = options.progress});
    const std::vector<std::uint32_t> all = allIndices(vectors.count());
    Assignment assignment = assignVectors(vectors, all, centroids, options.threadCount);
    fillEmptyClusters(assignment, clusterCount);
    VectorGroups groups = groupByLabel(all, assignment.labels, clusterCount);
    sortVectors(vectors, std::move(groups.order), options.threadCount, sorted);
    std::vector<std::uint32_t> labels;
    for (const std::uint32_t vector : sorted.original)
        labels.push_back(assignment.labels[vector]);
    return fitClusters(sorted.weighted, std::move(labels), centroids, axisCount,
                       options.threadCount);
}

/// Sorts the vectors by the clusters that they are in now.
void sortAgain(const WeightedVectors& vectors, int threadCount, Clustering& clustering,
               SortedVectors& sorted) {
    std::vector<std::uint32_t> original, labels;
    for (const std::uint32_t member : clustering.groups.order) {
        original.push_back(sorted.original[member]);
        labels.push_back(clustering.labels[member]);
    }
    sortVectors(vectors, std::move(original), threadCount, sorted);
    clustering.labels = std::move(labels);
    clustering.groups.order = allIndices(vectors.count());
}

std::size_t countDifferences(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += a[i] != b[i] ? 1 : 0;
    return count;
}

/// Reassigns and fits in turns while the error falls.
///
/// @param sorted  sorted again when many vectors have moved
Clustering iterate(const WeightedVectors& vectors, Clustering clustering, std::size_t axisCount,
                   const ClusteredPcaOptions& options, SortedVectors& sorted) {
    std::size_t movedCount = 0;
    constexpr std::size_t kSearchPeriod = 10;  // one search of so many is among all
    constexpr double kLeastNearGain = 0.002;   // of the error: less is not worth a near search
    ProgressReporter reporter(options.progress, "cluster", "iterations", options.iterationCount);
    bool nearHelps = true;
    for (std::size_t iteration = 0; iteration < options.iterationCount; ++iteration) {
        const bool searchesAll = !nearHelps || (iteration + 1) % kSearchPeriod == 0 ||
                                 clustering.axes.size() <= kNearCount;
        const std::vector<Subspace> subspaces = listSubspaces(clustering);
        Assignment assignment =
            reassignVectors(sorted.weighted, clustering.groups, subspaces,
                            searchesAll ? Search::all : Search::near, options.threadCount);
        fillEmptyClusters(assignment, subspaces.size());
        Clustering next = fitClusters(sorted.weighted, std::move(assignment.labels), subspaces,
                                      axisCount, options.threadCount);
        const double gain = clustering.squaredError - next.squaredError;
        nearHelps = searchesAll || gain > kLeastNearGain * clustering.squaredError;
        if (gain > 0.0) {
            movedCount += countDifferences(next.labels, clustering.labels);
            clustering = std::move(next);
        } else if (searchesAll) {
            reporter.advance(options.iterationCount - iteration);
            break;
        }
        if (movedCount > vectors.count() / 3) {
            sortAgain(vectors, options.threadCount, clustering, sorted);
            movedCount = 0;
        }
        reporter.advance(1);
    }
    return clustering;
}

/// Gives components to the clusters where one explains most, until the error is reached; or, where
/// the number of weights is limited, where a weight explains most.
std::vector<std::size_t> allotComponents(const Clustering& clustering, double maxSquaredError,
                                         double weightCount, bool isBudgeted) {
    struct Component {
        double squares;
        double members;
        std::size_t cluster;
    };
    std::vector<Component> components;
    double squaredError = 0.0;
    for (std::size_t k = 0; k < clustering.axes.size(); ++k) {
        squaredError += clustering.axes[k].totalSquares;
        const auto members =
            isBudgeted ? static_cast<double>(clustering.groups.members(k).size()) : 1.0;
        for (const double squares : clustering.axes[k].squares)
            components.push_back({squares, members, k});
    }
    std::stable_sort(components.begin(), components.end(),
                     [](const Component& a, const Component& b) {
                         return a.squares * b.members > b.squares * a.members;
                     });
    std::vector<std::size_t> counts(clustering.axes.size(), 0);
    std::vector<bool> isFull(clustering.axes.size(), false);
    for (const Component& component : components) {
        if (squaredError <= maxSquaredError) break;
        if (component.members > weightCount) isFull[component.cluster] = true;
        if (isFull[component.cluster]) continue;
        squaredError -= component.squares;
        weightCount -= component.members;
        ++counts[component.cluster];
    }
    return counts;
}

double sumErrors(const Clustering& clustering, std::span<const std::size_t> counts) {
    double squaredError = 0.0;
    for (std::size_t k = 0; k < counts.size(); ++k)
        squaredError += clustering.axes[k].squaredError(counts[k]);
    return squaredError;
}

/// Counts of components, adaptive where the options ask for it.
std::vector<std::size_t> chooseCounts(const Clustering& clustering, double maxSquaredError,
                                      double averageCount, bool isBudgeted) {
    const auto vectorCount = static_cast<double>(clustering.labels.size());
    std::vector<std::size_t> counts =
        allotComponents(clustering, maxSquaredError, averageCount * vectorCount, isBudgeted);
    // What is left of a limited number of weights may fit no component.
    const std::vector<std::size_t> even(counts.size(), static_cast<std::size_t>(averageCount));
    const double squaredError = sumErrors(clustering, counts);
    if (squaredError > maxSquaredError && sumErrors(clustering, even) < squaredError) {
        for (std::size_t k = 0; k < even.size(); ++k)
            counts[k] = std::min(even[k], clustering.axes[k].squares.size());
    }
    return counts;
}

/// Stores the clusters that have vectors.
ClusteredPca encode(const SortedVectors& sorted, Clustering clustering,
                    std::span<const std::size_t> counts, int threadCount) {
    const WeightedVectors& vectors = sorted.weighted;
    ClusteredPca pca;
    pca.dimension = vectors.dimension;
    pca.weightStride = *std::max_element(counts.begin(), counts.end());
    pca.firstComponent = {0};
    std::vector<float> weights(vectors.count() * pca.weightStride, 0.0f);
    for (std::size_t k = 0; k < counts.size(); ++k) {
        const auto members = clustering.groups.members(k);
        if (members.empty()) continue;
        const StoredNumbers stored =
            unweighSubspace(vectors, clustering.axes[k].subspace, counts[k]);
        pca.squaredError += encodeVectors(vectors, members, {stored.mean, stored.components},
                                          pca.weightStride, weights, threadCount);
        for (const std::uint32_t member : members)
            clustering.labels[member] = static_cast<std::uint32_t>(pca.clusterCount());
        pca.means.insert(pca.means.end(), stored.mean.begin(), stored.mean.end());
        pca.components.insert(pca.components.end(), stored.components.begin(),
                              stored.components.end());
        pca.firstComponent.push_back(pca.components.size() / pca.dimension);
    }
    pca.labels = restoreOrder<std::uint32_t>(clustering.labels, 1, sorted.original);
    pca.weights = restoreOrder<float>(weights, pca.weightStride, sorted.original);
    return pca;
}

}  // namespace

ClusteredPca computeClusteredPca(const VectorSet& vectors, const ClusteredPcaOptions& options) {
    PRT_ASSERT(options.clusterCount > 0, "there is a cluster");
    const bool isBudgeted = options.averageComponentCount > 0.0;
    const double averageCount =
        isBudgeted ? options.averageComponentCount : static_cast<double>(options.componentCount);
    const std::size_t axisCount =
        std::min(options.componentCount, static_cast<std::size_t>(std::lround(averageCount)));
    const WeightedVectors weighted = weighVectors(vectors, options.threadCount);
    SortedVectors sorted;
    Clustering clustering = startClusters(weighted, axisCount, options, sorted);
    clustering = iterate(weighted, std::move(clustering), axisCount, options, sorted);
    if (axisCount < options.componentCount) {
        const std::vector<Subspace> subspaces = listSubspaces(clustering);
        clustering = fitClusters(sorted.weighted, std::move(clustering.labels), subspaces,
                                 options.componentCount, options.threadCount);
    }
    const auto numberCount = static_cast<double>(vectors.numbers.size());
    const double maxSquaredError =
        options.maxError * options.maxError * numberCount / weighted.squaredErrorUnit;
    const auto counts = chooseCounts(clustering, maxSquaredError, averageCount, isBudgeted);
    return encode(sorted, std::move(clustering), counts, options.threadCount);
}

void expandVector(const ClusteredPca& pca, std::size_t vector, std::span<float> numbers) {
    PRT_ASSERT(numbers.size() == pca.dimension, "there is room for one vector");
    const std::size_t cluster = pca.labels[vector];
    const float* weights = pca.weights.data() + vector * pca.weightStride;
    const float* components = pca.components.data() + pca.firstComponent[cluster] * pca.dimension;
    for (std::size_t j = 0; j < pca.dimension; ++j) {
        double sum = pca.means[cluster * pca.dimension + j];
        for (std::size_t p = 0; p < pca.componentCount(cluster); ++p)
            sum += double{weights[p]} * components[p * pca.dimension + j];
        numbers[j] = static_cast<float>(sum);
    }
}

}  // namespace prt
