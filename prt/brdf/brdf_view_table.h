#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "prt/brdf/horizon_fit.h"
#include "prt/brdf/lobe_quadrature.h"

namespace prt {

struct BrdfViewTableOptions {
    int bandCount = 5;   ///< n of incident radiance
    int viewCount = 32;  ///< of the angle to the normal, finer at the horizon; at least 2
    double horizonWeight = kHorizonFitWeight;  ///< ε of HorizonFit; 1: not fitted
    LobeQuadratureOptions quadrature = {};
};

/// What one BRDF makes of incident radiance for one view: f_i(ω_o) of projectBrdfView, fitted for
/// radiance that is 0 below the horizon (HorizonFit), from a table of θ_o, linear between.
/// GltfViewTable is the same for all glTF materials.
///
/// Of a measured BRDF that is not mirror symmetric this is the mean of itself and its mirror image.
class BrdfViewTable {
  public:
    explicit BrdfViewTable(const Brdf& brdf, const BrdfViewTableOptions& options = {});

    int bandCount() const { return bandCount_; }
    std::size_t viewCount() const { return viewCount_; }

    /// @param view      ω_o, unit, local frame; below the horizon it counts as at it
    /// @param response  [channel][i]: f_i is added
    void addResponse(const Vec3f& view, std::span<float> response) const;

    /// The coefficients for the table's view of this index (view_angle.h), [channel][uprightIndex].
    std::span<const float> row(std::size_t view) const;

  private:
    int bandCount_;
    std::size_t viewCount_;
    std::vector<float> rows_;  // [view][channel][uprightIndex]
};

}  // namespace prt
