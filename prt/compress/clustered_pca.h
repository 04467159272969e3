#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/compress/vector_set.h"
#include "prt/parallel/progress.h"

namespace prt {

struct ClusteredPcaOptions {
    std::size_t clusterCount = 256;
    std::size_t componentCount = 8;      ///< of each cluster beyond its mean; the most, if adaptive
    double averageComponentCount = 0.0;  ///< adaptive: so many a vector on average; 0: no limit
    double maxError = 0.0;  ///< adaptive: as few as keep this root mean square of w_j (x_j − x̂_j)
                            ///< over all numbers; 0: all
    std::size_t iterationCount =
        20;  ///< of reassigning the vectors; stops earlier where none helps
    std::uint64_t seed = 1;
    int threadCount = 0;          ///< 0: one a core
    ProgressCallback progress{};  ///< stages "quantise" and "cluster"
};

/// Vectors in clusters, each with a mean and components of its own:
///
///   x ≈ m_k + Σ_p t_p b_kp,   k the label of x                                        [Sloan03]
struct ClusteredPca {
    std::size_t dimension = 0;
    std::size_t weightStride = 0;             ///< the most components that a cluster has
    std::vector<float> means;                 ///< m: [cluster][dimension]
    std::vector<float> components;            ///< b: [component][dimension], cluster after cluster;
                                              ///< Σ_j w_j² b_pj b_qj = δ_pq within a cluster
    std::vector<std::size_t> firstComponent;  ///< [cluster + 1], into components
    std::vector<std::uint32_t> labels;        ///< k: [vector]
    std::vector<float> weights;               ///< t: [vector][weightStride]; 0 beyond its cluster's
    double squaredError = 0.0;  ///< Σ w_j² (x_j − x̂_j)², measured with the numbers above

    std::size_t clusterCount() const { return means.size() / dimension; }
    std::size_t componentCount(std::size_t cluster) const {
        return firstComponent[cluster + 1] - firstComponent[cluster];
    }
};

/// Clusters vectors by k-means, then again and again finds each cluster's principal components and
/// moves each vector to the cluster that reproduces it best [Sloan03], until no vector gains.
///
/// The error never rises with iterationCount. Where there are more than 16 clusters, most
/// iterations look for a vector's cluster among those 16 that reproduce the present members of its
/// own best; every tenth, and each when that no longer helps much, looks among all.
///
/// Adaptive counts are given after the last iteration, to the components that explain most; where
/// averageComponentCount limits them, most for each weight that is stored.
///
/// There are fewer clusters and components than asked for where these reproduce all vectors to
/// float. The same seed gives the same bits for any number of threads (C10).
///
/// Differs from the paper, which looks among all clusters every time.
///
/// @param vectors  at least one
ClusteredPca computeClusteredPca(const VectorSet& vectors, const ClusteredPcaOptions& options = {});

/// m_k + Σ_p t_p b_kp of one vector. @param numbers  [dimension], written
void expandVector(const ClusteredPca& pca, std::size_t vector, std::span<float> numbers);

}  // namespace prt
