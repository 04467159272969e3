#pragma once

#include <span>

#include "prt/image/tone_curve.h"
#include "prt/relight/exit_radiance.h"
#include "prt/render/mirror_shading.h"
#include "prt/scene/scene.h"

namespace prt {

/// The scene with its light painted onto its vertices, for viewers that know no transfer: what they
/// show without light of their own (GlbOptions::unlit) is vertex colour × texture.
///
///   colour = display(base colour factor · vertex colour · B + emission)               (C7)
///
/// Textures of base colour stay, and are multiplied after exposure, curve and clamp: without a
/// curve that is radiance itself, up to 1. Emission can only be added where there is no such
/// texture; where it is left out, the result has a warning. All other maps are dropped.
///
/// @param scene           textures decoded where they are of emission
/// @param vertexRadiance  B of every vertex, before albedo, mesh after mesh, W·sr⁻¹·m⁻²
/// @param display         its default is a curve; none keeps radiance in proportion
Scene freezeScene(const Scene& scene, std::span<const Vec3f> vertexRadiance,
                  const DisplayOptions& display = {});

/// The same of any materials, as they are seen from one place: highlights stay where that eye sees
/// them. The vertices show all there is, and no texture stays.
///
/// @param scene, vertexRadiance, eye, mirrors  as shadeVertices takes them
Scene freezeView(const Scene& scene, std::span<const ExitRadiance> vertexRadiance, const Vec3f& eye,
                 const MirrorEnvironment* mirrors, const DisplayOptions& display = {});

}  // namespace prt
