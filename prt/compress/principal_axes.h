#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/compress/subspace_kernel.h"
#include "prt/compress/weighted_vectors.h"

namespace prt {

/// The affine subspace nearest to some vectors, and what it leaves of them.
struct PrincipalAxes {
    Subspace subspace;
    std::vector<double> squares;  ///< what each axis explains, Σ_y ⟨a, y − m⟩², descending
    double totalSquares = 0.0;    ///< Σ_y ‖y − m‖²

    /// Σ_y ‖y − ŷ‖² with the first axes only.
    double squaredError(std::size_t axisCount) const;
};

/// Mean and principal axes of some vectors, in double.
///
/// From the matrix of products of dimensions, or of vectors where these are fewer. A small one is
/// diagonalised; of one above 256 with few axes asked for, these are found by subspace iteration,
/// which stops when a step explains less than 10⁻⁶ of the error more.
///
/// Axes that explain less than 10⁻¹³ of the squares, which is rounding of the floats, are left out,
/// so there can be fewer than axisCount.
///
/// @param members  indices, at least one
PrincipalAxes findPrincipalAxes(const WeightedVectors& vectors,
                                std::span<const std::uint32_t> members, std::size_t axisCount,
                                int threadCount);

}  // namespace prt
