#pragma once

#include <optional>
#include <span>
#include <vector>

#include "prt/relight/exit_radiance.h"
#include "prt/render/mirror_shading.h"
#include "prt/scene/scene.h"
#include "prt/scene/surface_color.h"

namespace prt {

/// Linear in the triangle, as interpolateCorners.
ExitRadiance interpolateExit(const Mesh& mesh, const SurfacePoint& point,
                             std::span<const ExitRadiance> meshRadiance);

/// What a point sends to the eye, without what it emits: base colour · perBaseColor + constant, and
/// of the environment what mirrorVisibility lets through; material and mirrored direction are the
/// point's own.
///
/// @param normal, view  as for showMirrored
/// @param mirrors       null: nothing is mirrored
Vec3f shadePoint(const Scene& scene, const SurfacePoint& point, const ExitRadiance& radiance,
                 const Vec3f& normal, const Vec3f& view, const MirrorEnvironment* mirrors);

/// Where each vertex of a scene is a corner; none where no triangle has it.
std::vector<std::optional<SurfacePoint>> findVertexPoints(const Scene& scene);

/// What every vertex sends to the eye, as a picture would show it, without what it emits; 0 where
/// no triangle has it.
///
/// @param vertexRadiance  one a vertex of the scene, mesh after mesh
/// @param eye             world space
std::vector<Vec3f> shadeVertices(const Scene& scene, std::span<const ExitRadiance> vertexRadiance,
                                 const Vec3f& eye, const MirrorEnvironment* mirrors);

}  // namespace prt
