#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prt/base/random.h"
#include "prt/compress/kmeans.h"
#include "prt/compress/subspace_kernel.h"
#include "prt/compress/weighted_vectors.h"

namespace prt {

/// Labels of vectors, and how far each is from what its label stands for.
struct Assignment {
    std::vector<std::uint32_t> labels;
    std::vector<float> squaredDistances;
};

/// One index at random from each of `count` equal parts of [0, total), ascending; all indices where
/// these are no more.
std::vector<std::uint32_t> drawIndices(std::size_t total, std::size_t count, RandomStream random);

/// Finds the nearest of some points, or subspaces, for each of some vectors.
Assignment assignVectors(const WeightedVectors& vectors, std::span<const std::uint32_t> indices,
                         std::span<const Subspace> subspaces, int threadCount);

/// The vectors that are worst off: positions in `squaredDistances` of those farthest away, the
/// farthest first; none at distance 0.
std::vector<std::size_t> findFarthest(std::span<const float> squaredDistances, std::size_t count);

/// Centroids of clusters, in the space of WeightedVectors.
std::vector<Subspace> trainCentroids(const WeightedVectors& vectors, const KMeansOptions& options);

}  // namespace prt
