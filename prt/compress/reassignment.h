#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prt/compress/lloyd.h"
#include "prt/compress/subspace_kernel.h"
#include "prt/compress/weighted_vectors.h"

namespace prt {

/// Among which clusters a vector looks for a better one.
enum class Search {
    near,  ///< those that reproduce some members of its present cluster best
    all,
};

/// With so many clusters or fewer, the near ones are all.
constexpr std::size_t kNearCount = 16;

/// Moves each vector to the subspace nearest to it; it stays where the gain is within rounding.
///
/// @param groups  the present clusters, of all vectors
/// @return        for all vectors
Assignment reassignVectors(const WeightedVectors& vectors, const VectorGroups& groups,
                           std::span<const Subspace> subspaces, Search search, int threadCount);

}  // namespace prt
