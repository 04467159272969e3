#pragma once

#include "prt/gpu/gpu_background.h"
#include "prt/gpu/gpu_radiance.h"
#include "prt/gpu/gpu_scene.h"
#include "prt/gpu/gpu_target.h"
#include "prt/scene/scene.h"

namespace prt {

struct GpuViewOptions {
    const GpuBackground* background = nullptr;  ///< seen where no surface is; black without
    Mat3d worldFromBackground{};                ///< a rotation: L(R⁻¹ω)
};

/// Draws a picture of a relit scene, as renderView makes it: linear radiance, unclamped. Differs: a
/// pixel is what its centre shows, or the mean of as many places as the target has samples; and
/// what lies nearer than a thousandth of the farthest point is not seen.
///
/// Leaves depth test, culling, program, textures and buffers as it needs them.
///
/// @param scene, radiance  of the same vertices
/// @param target           of floats
/// @throws Error           invalidOption for a field of view out of range
void drawGpuView(const GpuScene& scene, const GpuRadiance& radiance, const Camera& camera,
                 const GpuTarget& target, const GpuViewOptions& options = {});

}  // namespace prt
