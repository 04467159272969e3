#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "prt/brdf/brdf_view_table.h"
#include "prt/brdf/gltf_view_table.h"
#include "prt/math/vector.h"
#include "prt/scene/scene.h"
#include "prt/scene/surface_color.h"

namespace prt {

/// How the surfaces of a scene reflect: what coefficients l_i of incident radiance in the local
/// frame send towards ω_o is Σ_i f_i(ω_o) l_i, with
///
///   f_i(ω_o) = ∫ f_r(ω_i, ω_o) max(cos θ_i, 0) y_i(ω_i) dω_i                          [Kautz02]
///
/// As nothing comes in from below the horizon, f_i may be of any function that is right above it.
/// Called by many threads at once.
///
/// @param point     whose material it is
/// @param view      ω_o, unit, local frame; a little below the horizon where shading normals lean
/// @param response  [channel][i], zeros: f_i is added
using SurfaceReflection =
    std::function<void(const SurfacePoint& point, const Vec3f& view, std::span<float> response)>;

/// Albedo/π of the base colour. Above the horizon the cosine is one coefficient, cos θ =
/// √(4π/3) y_10, so that two bands of incident radiance hold a Lambert surface exactly.
///
/// @param scene  must outlive it; textures decoded
SurfaceReflection lambertReflection(const Scene& scene);

/// Diffuse and specular light of glTF materials with their textures.
///
/// @param scene  must outlive it; textures decoded
/// @param table  for the bands of the incident radiance
SurfaceReflection gltfReflection(const Scene& scene, std::shared_ptr<const GltfViewTable> table);

/// Surfaces of other BRDFs than their glTF materials say.
///
/// @param scene   must outlive it; textures decoded where a material stays as it is
/// @param tables  one a material of the scene; null: the material stays as it is
/// @param gltf    for those that stay; of as many bands
SurfaceReflection brdfReflection(const Scene& scene,
                                 std::vector<std::shared_ptr<const BrdfViewTable>> tables,
                                 std::shared_ptr<const GltfViewTable> gltf = nullptr);

/// f_10 of albedo 1: row (1, 0) of a transfer matrix times this is the diffuse transfer vector
/// (C6).
inline constexpr float kLambertResponse = 0.65147001587055990f;  // sqrt(4 / (3 pi))

}  // namespace prt
