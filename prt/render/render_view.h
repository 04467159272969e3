#pragma once

#include <cstdint>
#include <span>

#include "prt/image/image.h"
#include "prt/light/environment.h"
#include "prt/parallel/progress.h"
#include "prt/relight/exit_radiance.h"
#include "prt/scene/scene.h"
#include "prt/trace/ray_scene.h"

namespace prt {

struct MirrorEnvironment;

struct RenderOptions {
    int width = 1280;
    int height = 720;
    int samplesPerAxis = 4;  ///< stratified, samplesPerAxis² rays a pixel; at most 64
    const Environment* background = nullptr;     ///< seen where no surface is; black without
    Mat3d worldFromBackground{};                 ///< a rotation: L(R⁻¹ω)
    const MirrorEnvironment* mirrors = nullptr;  ///< what mirror-like surfaces show of the light
    std::uint64_t seed = 1;
    int threadCount = 0;  ///< 0: one a core
    ProgressCallback progress{};
};

/// A picture of a relit scene: rays find the visible surface, B is interpolated in the triangle
/// (C7), multiplied by the base colour at the point, and emission is added. A pixel is the mean of
/// its rays. Negative radiance of band-limited light stays negative (C5).
///
/// A one-sided surface is invisible from behind, so that one can look into a closed room from
/// outside. The back of a double-sided one shows the same B as its front.
///
/// @param scene           textures decoded
/// @param rays            of the same scene
/// @param vertexRadiance  B of every vertex of the scene, before albedo,
///                        numbered mesh after mesh, W·sr⁻¹·m⁻²
/// @return                linear radiance; the same for any number of threads (C10)
/// @throws Error          invalidOption for a size, sample count or field
///                        of view out of range, cancelled
Image renderView(const Scene& scene, const RayScene& rays, std::span<const Vec3f> vertexRadiance,
                 const Camera& camera, const RenderOptions& options = {});

/// The same of any materials: a point sends what shadePoint says of the interpolated radiance.
///
/// @param vertexRadiance  of every vertex, towards the camera's eye
/// @param options         without mirrors the light that mirrorVisibility lets through is left out
Image renderView(const Scene& scene, const RayScene& rays,
                 std::span<const ExitRadiance> vertexRadiance, const Camera& camera,
                 const RenderOptions& options = {});

}  // namespace prt
