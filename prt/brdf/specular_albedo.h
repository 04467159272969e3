#pragma once

#include <cstddef>
#include <vector>

#include "prt/brdf/lobe_quadrature.h"

namespace prt {

struct SpecularAlbedoOptions {
    int levelCount = 32;  ///< of roughness from 0 to 1, at least 2
    int viewCount = 32;   ///< of the angle to the normal, finer at the horizon; at least 2
    LobeQuadratureOptions quadrature = {.polarNodeCount = 32, .azimuthNodeCount = 12};
};

/// The share of light from everywhere that a glTF material's specular lobe reflects to a view,
/// ∫ f_r(ω_i, ω_o) max(cos θ_i, 0) dω_i, from a table of roughness and θ_o, linear between.
class SpecularAlbedoTable {
  public:
    explicit SpecularAlbedoTable(const SpecularAlbedoOptions& options = {});

    /// @param f0      what the lobe reflects along the normal
    /// @param cosine  of θ_o; below the horizon counts as at it
    Vec3f evaluate(const Vec3f& f0, float roughness, float cosine) const;

    /// Of F0 = 0 and of F0 = 1: F is linear in F0.
    struct Entry {
        float dark = 0.0f;
        float bright = 0.0f;
    };

    /// [roughness][view], as evaluate looks them up.
    const std::vector<Entry>& entries() const { return entries_; }
    std::size_t viewCount() const { return viewCount_; }

  private:
    std::size_t levelCount_;
    std::size_t viewCount_;
    std::vector<Entry> entries_;  // [level][view]
};

}  // namespace prt
