#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/basis/sh.h"
#include "prt/math/vector.h"

namespace prt {

/// Makes transfer matrices of visibility:
///
///   M_ij = ∫ y_i(R ω) V(ω) y_j(ω) dω,   R = local from world, of frameFromNormal      [Sloan02, 5]
///
/// so that Σ_j M_ij L_j is the radiance that distant light L brings to a receiver, in the
/// receiver's own frame. They come from few numbers, v_k = ∫ V y_k, by product integrals
/// [Sloan08, appendix A4]:
///
///   ∫ y_i V y_j = Σ_k v_k ∫ y_i y_j y_k,
///
/// and a rotation of the rows. y_i y_j has n_in + n − 1 bands: with as many of V nothing is lost,
/// and a sum over rays in place of the integral gives just what that sum of y_i V y_j would.
class VisibilityMatrix {
  public:
    /// @param incidentBandCount  n_in ≥ 1, of the incident radiance
    /// @param bandCount          n ≥ 1, of the light; n_in + n − 1 ≤ kMaxBandCount
    VisibilityMatrix(int incidentBandCount, int bandCount);

    int incidentBandCount() const { return incidentBandCount_; }
    int bandCount() const { return bandCount_; }
    int visibilityBandCount() const { return incidentBandCount_ + bandCount_ - 1; }
    /// n_in² n².
    std::size_t elementCount() const { return terms_.size(); }

    /// @param visibility  v: visibilityBandCount()² numbers, world frame
    /// @param normal      unit, +z of the local frame
    /// @param scratch     elementCount() numbers, written
    /// @param matrix      [i][j], written
    void make(std::span<const float> visibility, const Vec3f& normal, std::span<float> scratch,
              std::span<float> matrix) const;

  private:
    struct Term {
        std::uint32_t visibilityIndex = 0;
        float integral = 0.0f;
    };

    int incidentBandCount_;
    int bandCount_;
    std::vector<std::vector<Term>> terms_;  // of element [j][i], before the rotation
};

}  // namespace prt
