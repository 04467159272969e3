#include "prt/compress/cluster_training.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "prt/compress/clustered_pca.h"
#include "prt/compress/kmeans.h"
#include "prt/compress/lloyd.h"
#include "prt/compress/table_rows.h"

namespace prt {
namespace {

std::size_t chooseTrainingCount(const CoefficientTable& numbers, const ClusterOptions& options) {
    constexpr std::size_t kMostNumbers = std::size_t{1} << 27;
    const std::size_t asked =
        options.trainingCount > 0 ? options.trainingCount : kMostNumbers / numbers.columnCount();
    return std::min(std::max(asked, options.clusterCount), numbers.rowCount());
}

/// Rows of a table, one after another.
std::vector<float> copyTrainingRows(const CoefficientTable& numbers,
                                    const ClusterOptions& options) {
    const auto indices = drawIndices(numbers.rowCount(), chooseTrainingCount(numbers, options),
                                     RandomStream(options.seed, 4));
    std::vector<float> rows(indices.size() * numbers.columnCount());
    readRows(numbers, indices, rows);
    numbers.releaseMemory();
    return rows;
}

/// √(mean of w_j² x_j²).
double rootMeanSquare(const VectorSet& vectors) {
    double sum = 0.0;
    for (std::size_t i = 0; i < vectors.numbers.size(); ++i) {
        const std::size_t j = i % vectors.dimension;
        const double weight = vectors.errorWeights.empty() ? 1.0 : double{vectors.errorWeights[j]};
        sum += weight * weight * vectors.numbers[i] * vectors.numbers[i];
    }
    return std::sqrt(sum / static_cast<double>(vectors.numbers.size()));
}

}  // namespace

Clusters trainClusters(const CoefficientTable& numbers, std::span<const float> errorWeights,
                       const ClusterOptions& options, int threadCount,
                       const ProgressCallback& progress) {
    const std::vector<float> rows = copyTrainingRows(numbers, options);
    const VectorSet vectors{rows, numbers.columnCount(), errorWeights};
    if (options.componentCount == 0) {
        KMeans means = computeKMeans(vectors, {.clusterCount = options.clusterCount,
                                               .iterationCount = options.iterationCount,
                                               .seed = options.seed,
                                               .threadCount = threadCount,
                                               .progress = progress});
        const std::size_t count = means.clusterCount();
        return {vectors.dimension,
                std::move(means.centroids),
                {},
                std::vector<std::size_t>(count + 1, 0)};
    }
    const double maxError =
        options.maxError > 0.0 ? options.maxError * rootMeanSquare(vectors) : 0.0;
    ClusteredPca pca = computeClusteredPca(vectors, {.clusterCount = options.clusterCount,
                                                     .componentCount = options.componentCount,
                                                     .maxError = maxError,
                                                     .iterationCount = options.iterationCount,
                                                     .seed = options.seed,
                                                     .threadCount = threadCount,
                                                     .progress = progress});
    return {vectors.dimension, std::move(pca.means), std::move(pca.components),
            std::move(pca.firstComponent)};
}

}  // namespace prt
