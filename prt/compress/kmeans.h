#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "prt/compress/vector_set.h"
#include "prt/parallel/progress.h"

namespace prt {

struct KMeansOptions {
    std::size_t clusterCount = 256;
    std::size_t iterationCount = 20;  ///< of moving the centroids; stops earlier where none helps
    std::size_t trainingCount = 0;    ///< so many vectors, spread over all, find the centroids; 0:
                                      ///< all vectors
    std::uint64_t seed = 1;
    int threadCount = 0;          ///< 0: one a core
    ProgressCallback progress{};  ///< stage "quantise"
};

/// Vectors as the centroids of clusters: vector quantisation.
struct KMeans {
    std::size_t dimension = 0;
    std::vector<float> centroids;       ///< [cluster][dimension]
    std::vector<std::uint32_t> labels;  ///< [vector]: the nearest centroid, to rounding
    double squaredError = 0.0;  ///< Σ w_j² (x_j − c_j)², measured with the numbers above

    std::size_t clusterCount() const { return centroids.size() / dimension; }
};

/// Clusters vectors by Lloyd's iteration [Lloyd82] from k-means++ seeds [Arthur07].
///
/// Seeds are drawn from a part of the vectors. A cluster that loses all its vectors starts anew at
/// the vector that is farthest from its centroid. The error never rises with iterationCount, unless
/// only a part of the vectors is trained on. The same seed gives the same bits for any number of
/// threads (C10).
///
/// There are fewer clusters than asked for where there are fewer different vectors.
///
/// @param vectors  at least one
KMeans computeKMeans(const VectorSet& vectors, const KMeansOptions& options = {});

}  // namespace prt
