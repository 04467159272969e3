#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/compress/vector_set.h"

namespace prt {

/// Vectors in the space where all codecs work:
///
///   y_j = s_j (x_j − c_j),   s_j = w_j / u,   c the mean of all
///
/// There the weighted error is u² times a plain squared length, no number exceeds 1 in size, and
/// what all vectors have in common costs no digits.
struct WeightedVectors {
    std::span<const float> numbers;  ///< x: [vector][dimension]
    std::size_t dimension = 1;
    std::vector<float> origin;      ///< c
    std::vector<float> scale;       ///< s
    double squaredErrorUnit = 1.0;  ///< u²; u is a power of two

    std::size_t count() const { return numbers.size() / dimension; }
};

/// Finds the mean and the scale. @param threadCount  0: one a core
WeightedVectors weighVectors(const VectorSet& vectors, int threadCount);

/// y back to x: a point, and a difference of points.
std::vector<float> unweighPoint(const WeightedVectors& vectors, std::span<const double> point);
std::vector<float> unweighDirection(const WeightedVectors& vectors,
                                    std::span<const double> direction);

/// x to y, the same.
std::vector<double> weighPoint(const WeightedVectors& vectors, std::span<const float> point);
std::vector<double> weighDirection(const WeightedVectors& vectors,
                                   std::span<const float> direction);

/// Vectors in the order of their labels: which of them have label k stands at
/// order[first[k]] … order[first[k + 1] − 1], ascending.
struct VectorGroups {
    std::vector<std::size_t> first;    ///< [label + 1]
    std::vector<std::uint32_t> order;  ///< [vector]

    std::size_t groupCount() const { return first.size() - 1; }
    std::span<const std::uint32_t> members(std::size_t label) const {
        return std::span(order).subspan(first[label], first[label + 1] - first[label]);
    }
};

/// @param indices  the vectors, ascending
/// @param labels   one for each of them, less than groupCount
VectorGroups groupByLabel(std::span<const std::uint32_t> indices,
                          std::span<const std::uint32_t> labels, std::size_t groupCount);

/// 0, 1, … count − 1.
std::vector<std::uint32_t> allIndices(std::size_t count);

}  // namespace prt
