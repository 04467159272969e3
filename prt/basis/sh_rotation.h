#pragma once

#include <span>
#include <vector>

#include "prt/basis/sh.h"
#include "prt/math/transform.h"

namespace prt {

// Rotating a function f(ω) to f(R⁻¹ω) multiplies its coefficients by a matrix, one block a band:
//
//   (M c)_i = ∫ f(R⁻¹ω) y_i(ω) dω   where c_i = ∫ f y_i
//
// R is any orthogonal 3×3 matrix that acts on column vectors (C9), reflections included.

/// Rotates coefficients, fast: no matrix is built, and no angle computed.
///
///   R = Z(α) X(β) Z(γ),  X(β) = E Z(−β) E                              [Dachsbacher17; Pinchon07]
///
/// E exchanges two axes. Its matrix is constant and mostly zero, and turns about z only mix m and
/// −m. Differs from the sources, which turn about y and exchange y and z: exchanging z and x
/// keeps cosines apart from sines. Three bands are rotated sooner as a vector and a symmetric
/// matrix, and more than kMaxBandCount by ShRotation.
///
/// @param rotation   orthogonal
/// @param bandCount  n ≥ 1
/// @param source     n² numbers a channel, channel after channel
/// @param rotated    as many, written; may be `source`
void rotateSh(const Mat3d& rotation, int bandCount, std::span<const float> source,
              std::span<float> rotated);
void rotateSh(const Mat3d& rotation, int bandCount, std::span<const double> source,
              std::span<double> rotated);

/// Rotates 16 times at once, with the widest vectors of the machine: for instance one light into
/// the frames of 16 vertices.
///
/// @param rotations  entry (row, column) of orthogonal matrix j stands at 16·(3·row + column) + j
/// @param bandCount  n in [1, kMaxBandCount]
/// @param source     16·n² numbers, coefficient i of function j at 16·i + j; or n², one function
///                   for all
/// @param rotated    16·n² numbers, written likewise; may be `source`
void rotateShBatch(std::span<const float, 9 * kShBatchSize> rotations, int bandCount,
                   std::span<const float> source, std::span<float> rotated);

/// The matrix M, entry by entry.
///
/// Built by the recurrence of [Ivanic96] with the corrections of [Ivanic98]; signs adapted to the
/// Condon-Shortley phase (C2).
class ShRotation {
  public:
    /// @param rotation   orthogonal
    /// @param bandCount  n ≥ 1
    ShRotation(const Mat3d& rotation, int bandCount);

    int bandCount() const { return bandCount_; }

    /// Entry (m, k) of the block of degree l.
    double entry(int l, int m, int k) const;

    /// Rotates n² coefficients. `source` and `rotated` must not overlap.
    void apply(std::span<const double> source, std::span<double> rotated) const;

  private:
    int bandCount_;
    std::vector<double> blocks_;  // degree l: (2l+1)² entries, row-major
};

}  // namespace prt
