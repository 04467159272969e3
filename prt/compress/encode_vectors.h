#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/compress/subspace_kernel.h"
#include "prt/compress/weighted_vectors.h"

namespace prt {

/// A subspace in the numbers that are stored.
struct StoredSubspace {
    std::span<const float> mean;
    std::span<const float> components;  ///< [component][dimension]
};

/// A subspace in the units of the vectors.
struct StoredNumbers {
    std::vector<float> mean;
    std::vector<float> components;
};

/// @param axisCount  how many of the axes are kept
StoredNumbers unweighSubspace(const WeightedVectors& vectors, const Subspace& subspace,
                              std::size_t axisCount);

/// Finds the weights of vectors in a subspace as it is stored, and returns the squared error of
/// what those numbers give, measured in double.
///
/// @param weights  [vector][weightStride] of all vectors; those of the members are written
double encodeVectors(const WeightedVectors& vectors, std::span<const std::uint32_t> members,
                     const StoredSubspace& subspace, std::size_t weightStride,
                     std::span<float> weights, int threadCount);

}  // namespace prt
