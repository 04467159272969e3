#pragma once

#include <span>
#include <vector>

#include "prt/math/transform.h"

namespace prt {

/// The matrix that rotates spherical harmonic coefficients, one block a band.
///
///   (M c)_i = ∫ f(R⁻¹ω) y_i(ω) dω   where c_i = ∫ f y_i
///
/// Built by the recurrence of [Ivanic96] with the corrections of [Ivanic98], which holds for any
/// proper or improper orthogonal R; signs adapted to the Condon-Shortley phase (C2).
class ShRotation {
  public:
    /// @param rotation   orthogonal 3×3, acting on column vectors (C9)
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
