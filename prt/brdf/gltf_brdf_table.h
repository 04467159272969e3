#pragma once

#include <array>
#include <vector>

#include "prt/brdf/brdf_matrix.h"

namespace prt {

/// The matrices of all glTF materials (makeGltfBrdf). Schlick's F is linear in F0, so a roughness
/// needs two matrices, those of F0 = 0 and of F0 = 1, and the diffuse part one for all:
///
///   B = (1 − metallic) 0.96 base colour · B_diffuse + (1 − F0) B_dark + F0 B_bright
///
/// The matrices of evenly spaced roughnesses are kept, and cubics taken through four of them.
class GltfBrdfTable {
  public:
    /// @param levelCount  of roughness from 0 to 1; at least 4
    explicit GltfBrdfTable(const BrdfProjectionOptions& options = {}, int levelCount = 32);

    /// One matrix for each channel.
    std::array<BrdfMatrix, 3> project(const Vec3f& baseColor,
                                      const MetallicRoughness& surface) const;

    /// GGX with F0 = 0 and with F0 = 1.
    struct SpecularPair {
        BrdfMatrix dark;
        BrdfMatrix bright;
    };
    /// @param roughness  in [0, 1]
    SpecularPair specular(double roughness) const;

    /// A layered Lambert lobe of albedo 1.
    const BrdfMatrix& diffuse() const { return diffuse_; }

  private:
    BrdfMatrix diffuse_;
    std::vector<SpecularPair> levels_;
};

}  // namespace prt
