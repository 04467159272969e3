#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/compress/weighted_vectors.h"

namespace prt {

/// An affine subspace: all points mean + Σ_p t_p axis_p.
struct Subspace {
    std::vector<double> mean;
    std::vector<double> axes{};  ///< [axis][dimension], orthonormal

    std::size_t axisCount() const { return axes.size() / mean.size(); }
};

/// Subspaces as the kernel reads them. How well one approximates y is told by
///
///   g(y) = ⟨m, y⟩ − ‖m‖²/2 + ½ Σ_p (⟨a_p, y⟩ − ⟨a_p, m⟩)²,   ‖y − ŷ‖² = ‖y‖² − 2 g(y)
///
/// so the nearest has the largest g, each term of which is a row of numbers times y and a constant:
/// a point is a subspace without axes, and k-means runs on the same rows.
class SubspaceRows {
  public:
    static constexpr std::size_t kGroupSize = 6;  ///< rows that are multiplied at a time

    /// @param chosen  which of the subspaces, in this sequence
    SubspaceRows(std::span<const Subspace> subspaces, std::span<const std::uint32_t> chosen);

    std::size_t dimension = 0;
    std::size_t rowCount = 0;
    std::vector<float> numbers;         ///< [group][dimension][6], filled up with zeros
    std::vector<float> constants;       ///< [row], filled up so that no such row is best
    std::vector<std::uint8_t> isFirst;  ///< [row]: the mean of a subspace
    std::vector<std::uint8_t> isLast;   ///< [row]: no row of that subspace follows
    std::size_t subspaceCount = 0;

  private:
    void addRow(std::span<const double> row, double factor, double constant);
};

/// What the kernel finds of each vector: position in the chosen sequence, and squared distance.
struct NearestSubspaces {
    std::span<std::uint32_t> positions;
    std::span<float> squaredDistances;  ///< to rounding of 10⁻⁷ of the squared length
};

/// Finds the nearest subspace of each vector, the first of equals. So that rounding moves none to
/// and fro, the first subspace has the advantage of 2⁻²¹ of the squared length, where asked for.
///
/// @param members  indices of the vectors
void findNearestSubspaces(const WeightedVectors& vectors, std::span<const std::uint32_t> members,
                          const SubspaceRows& rows, bool prefersFirst,
                          const NearestSubspaces& nearest);

/// The squared distances of up to 64 vectors to all subspaces.
///
/// @param squaredDistances  [subspace][64], written
void measureSubspaceDistances(const WeightedVectors& vectors,
                              std::span<const std::uint32_t> members, const SubspaceRows& rows,
                              std::span<float> squaredDistances);

}  // namespace prt
