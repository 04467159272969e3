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

/// Reassigns and fits in turns while the error falls.
Clustering iterate(const WeightedVectors& vectors, Clustering clustering, std::size_t axisCount,
                   const ClusteredPcaOptions& options) {
    constexpr std::size_t kSearchPeriod = 10;  // one search of so many is among all
    constexpr double kLeastNearGain = 0.002;   // of the error: less is not worth a near search
    ProgressReporter reporter(options.progress, "cluster", "iterations", options.iterationCount);
    bool nearHelps = true;
    for (std::size_t iteration = 0; iteration < options.iterationCount; ++iteration) {
        const bool searchesAll = !nearHelps || (iteration + 1) % kSearchPeriod == 0 ||
                                 clustering.axes.size() <= kNearCount;
        const std::vector<Subspace> subspaces = listSubspaces(clustering);
        Assignment assignment =
            reassignVectors(vectors, clustering.groups, subspaces,
                            searchesAll ? Search::all : Search::near, options.threadCount);
        fillEmptyClusters(assignment, subspaces.size());
        Clustering next = fitClusters(vectors, std::move(assignment.labels), subspaces, axisCount,
                                      options.threadCount);
        const double gain = clustering.squaredError - next.squaredError;
        nearHelps = searchesAll || gain > kLeastNearGain * clustering.squaredError;
        if (gain > 0.0) {
            clustering = std::move(next);
        } else if (searchesAll) {
            reporter.advance(options.iterationCount - iteration);
            break;
        }
        reporter.advance(1);
    }
    return clustering;
}

/// Gives components to the clusters where a weight explains most, until the error or the number
/// of weights is reached.
std::vector<std::size_t> allotComponents(const Clustering& clustering, double maxSquaredError,
                                         double weightCount) {
    struct Component {
        double squares;
        double members;
        std::size_t cluster;
    };
    std::vector<Component> components;
    double squaredError = 0.0;
    for (std::size_t k = 0; k < clustering.axes.size(); ++k) {
        squaredError += clustering.axes[k].totalSquares;
        const auto members = static_cast<double>(clustering.groups.members(k).size());
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

/// Stores the clusters that have vectors.
ClusteredPca encode(const WeightedVectors& vectors, Clustering clustering,
                    std::span<const std::size_t> counts, int threadCount) {
    ClusteredPca pca;
    pca.dimension = vectors.dimension;
    pca.weightStride = *std::max_element(counts.begin(), counts.end());
    pca.firstComponent = {0};
    pca.labels = std::move(clustering.labels);
    pca.weights.assign(vectors.count() * pca.weightStride, 0.0f);
    for (std::size_t k = 0; k < counts.size(); ++k) {
        const auto members = clustering.groups.members(k);
        if (members.empty()) continue;
        const StoredNumbers stored =
            unweighSubspace(vectors, clustering.axes[k].subspace, counts[k]);
        pca.squaredError += encodeVectors(vectors, members, {stored.mean, stored.components},
                                          pca.weightStride, pca.weights, threadCount);
        for (const std::uint32_t member : members)
            pca.labels[member] = static_cast<std::uint32_t>(pca.clusterCount());
        pca.means.insert(pca.means.end(), stored.mean.begin(), stored.mean.end());
        pca.components.insert(pca.components.end(), stored.components.begin(),
                              stored.components.end());
        pca.firstComponent.push_back(pca.components.size() / pca.dimension);
    }
    return pca;
}

}  // namespace

ClusteredPca computeClusteredPca(const VectorSet& vectors, const ClusteredPcaOptions& options) {
    PRT_ASSERT(options.clusterCount > 0, "there is a cluster");
    constexpr std::size_t kTrainingPerCluster = 128;
    const WeightedVectors weighted = weighVectors(vectors, options.threadCount);
    const std::size_t clusterCount = std::min(options.clusterCount, vectors.count());
    const std::vector<Subspace> centroids =
        trainCentroids(weighted, {.clusterCount = clusterCount,
                                  .iterationCount = 10,
                                  .trainingCount = kTrainingPerCluster * clusterCount,
                                  .seed = options.seed,
                                  .threadCount = options.threadCount,
                                  .progress = options.progress});
    const bool isBudgeted = options.averageComponentCount > 0.0;
    const std::size_t axisCount =
        isBudgeted ? std::min(options.componentCount,
                              static_cast<std::size_t>(std::lround(options.averageComponentCount)))
                   : options.componentCount;
    Assignment assignment =
        assignVectors(weighted, allIndices(vectors.count()), centroids, options.threadCount);
    fillEmptyClusters(assignment, centroids.size());
    Clustering clustering = fitClusters(weighted, std::move(assignment.labels), centroids,
                                        axisCount, options.threadCount);
    clustering = iterate(weighted, std::move(clustering), axisCount, options);
    if (axisCount < options.componentCount) {
        const std::vector<Subspace> subspaces = listSubspaces(clustering);
        clustering = fitClusters(weighted, std::move(clustering.labels), subspaces,
                                 options.componentCount, options.threadCount);
    }

    const double vectorCount = static_cast<double>(vectors.count());
    const double maxSquaredError = options.maxError * options.maxError * vectorCount *
                                   static_cast<double>(vectors.dimension) /
                                   weighted.squaredErrorUnit;
    const double weightCount =
        vectorCount *
        (isBudgeted ? options.averageComponentCount : static_cast<double>(options.componentCount));
    const auto counts = allotComponents(clustering, maxSquaredError, weightCount);
    return encode(weighted, std::move(clustering), counts, options.threadCount);
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
