#pragma once

#include <cstddef>
#include <span>

namespace prt {

/// Vectors to be compressed, and how much an error in each of their numbers counts.
///
/// All errors of the codecs are Σ_j w_j² (x_j − x̂_j)².
struct VectorSet {
    std::span<const float> numbers;            ///< [vector][dimension]; finite
    std::size_t dimension = 1;                 ///< at least 1
    std::span<const float> errorWeights = {};  ///< w, one a dimension, positive; empty: all 1

    std::size_t count() const { return numbers.size() / dimension; }
};

}  // namespace prt
