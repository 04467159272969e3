#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "prt/brdf/horizon_fit.h"
#include "prt/brdf/lobe_quadrature.h"

namespace prt {

struct GltfViewTableOptions {
    int bandCount = 5;    ///< n of incident radiance
    int levelCount = 32;  ///< of roughness from 0 to 1, at least 2
    int viewCount = 32;   ///< of the angle to the normal, finer at the horizon; at least 2
    double horizonWeight = kHorizonFitWeight;  ///< ε of HorizonFit; 1: not fitted
    /// Errs by a thousandth of the largest coefficient, which is less than being linear does.
    LobeQuadratureOptions quadrature = {.polarNodeCount = 48, .azimuthNodeCount = 24};
};

/// What any glTF material (makeGltfBrdf) makes of incident radiance for one view: f_i(ω_o) of
/// projectBrdfView, fitted for radiance that is 0 below the horizon (HorizonFit), from a table of
/// roughness and θ_o, linear between. Turned to azimuth 0 a view has only coefficients of m ≥ 0,
/// and Schlick's F is linear in F0: two tables serve all materials, and one their diffuse lobes.
class GltfViewTable {
  public:
    explicit GltfViewTable(const GltfViewTableOptions& options = {});

    int bandCount() const { return bandCount_; }
    std::size_t levelCount() const { return levelCount_; }
    std::size_t viewCount() const { return viewCount_; }

    /// @param baseColor  linear, in [0, 1]
    /// @param view       ω_o, unit, local frame; below the horizon it counts as at it
    /// @param response   [channel][i]: f_i is added
    void addResponse(const Vec3f& baseColor, const MetallicRoughness& surface, const Vec3f& view,
                     std::span<float> response) const;

    /// A coefficient (l, m ≥ 0) of GGX with F0 = 0 and F0 = 1, and of a layered Lambert lobe of
    /// albedo 1, which no roughness changes.
    struct Element {
        float dark = 0.0f;
        float bright = 0.0f;
        float diffuse = 0.0f;
    };

    /// What the table holds for a level of roughness (placeBetween) and a view (view_angle.h),
    /// [uprightIndex].
    std::span<const Element> row(std::size_t level, std::size_t view) const;

  private:
    int bandCount_;
    std::size_t levelCount_;
    std::size_t viewCount_;
    std::size_t elementCount_;       // uprightCount
    std::vector<Element> elements_;  // [level][view][uprightIndex]
};

}  // namespace prt
