#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/compress/weighted_vectors.h"

namespace prt {

/// Rows of doubles are padded with zeros to a multiple of 8.
constexpr std::size_t paddedSize(std::size_t size) {
    return (size + 7) / 8 * 8;
}

/// Writes y − shift of some vectors. @param rows  [member][paddedSize(dimension)]
void gatherRows(const WeightedVectors& vectors, std::span<const std::uint32_t> members,
                std::span<const double> shift, std::span<double> rows);

/// Adds each y − c to a sum of its label, c a point of the label, and returns Σ ‖y − c‖².
///
/// @param members  indices, as many as labels
/// @param points   c: [label][paddedSize(dimension)]
/// @param sums     the same; added to
double sumByLabel(const WeightedVectors& vectors, std::span<const std::uint32_t> members,
                  std::span<const std::uint32_t> labels, std::span<const double> points,
                  std::span<double> sums);

/// Adds rows to a sum. @param rows  [row][size], size a multiple of 8; @param sum  [size]
void addRows(std::span<const double> rows, std::span<double> sum);

/// Lowers distances[i] to ‖row_i − point‖² where that is less.
///
/// @param rows   [row][size], size a multiple of 8
/// @param point  [size]
void lowerDistances(std::span<const double> rows, std::span<const double> point,
                    std::span<double> distances);

/// Adds AᵀA to a symmetric matrix; of each pair of entries that the symmetry makes equal, only the
/// one right of the diagonal is sure to be written.
///
/// @param rows    A: [row][size], size a multiple of 8
/// @param matrix  [size][size]
void addProducts(std::span<const double> rows, std::size_t size, std::span<double> matrix);

/// Finds the weights of a row on orthonormal axes, and returns the squared length of what these, as
/// they are rounded, leave of it.
///
/// @param row      [size], size a multiple of 8
/// @param axes     [axis][size]
/// @param weights  one an axis, written
double projectRow(std::span<const double> row, std::span<const double> axes,
                  std::span<float> weights);

}  // namespace prt
