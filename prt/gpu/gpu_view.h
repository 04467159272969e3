#pragma once

#include "prt/gpu/gpu_relighter.h"
#include "prt/gpu/gpu_scene.h"
#include "prt/image/image.h"

namespace prt {

struct GpuViewOptions {
    int width = 1280;
    int height = 720;
    int sampleCount = 1;  ///< a pixel; the driver may take more, and has a limit
};

/// A picture of a relit scene, as renderView makes it: linear radiance, unclamped, black where
/// there is no surface. Differs: a pixel is what its centre shows, or the mean of so many places as
/// the driver spreads over it.
///
/// @param scene, relighter  of the same vertices
/// @throws Error            invalidOption for a size, sample count or field of view out of range,
///                          outOfMemory
Image renderGpuView(const GpuScene& scene, const GpuRelighter& relighter, const Camera& camera,
                    const GpuViewOptions& options = {});

/// Draws the scene into the viewport of the framebuffer that is bound, whose depth is cleared.
/// Leaves depth test, culling, program, textures and buffers as it needs them.
///
/// @param aspectRatio  width over height
void drawGpuScene(const GpuScene& scene, const GpuRelighter& relighter, const Camera& camera,
                  double aspectRatio);

}  // namespace prt
