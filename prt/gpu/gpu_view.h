#pragma once

#include <span>

#include "prt/gpu/gpu_background.h"
#include "prt/gpu/gpu_mirrors.h"
#include "prt/gpu/gpu_radiance.h"
#include "prt/gpu/gpu_scene.h"
#include "prt/gpu/gpu_target.h"
#include "prt/math/transform.h"
#include "prt/scene/scene.h"

namespace prt {

/// A relit scene and where it stands.
struct GpuObject {
    const GpuScene* scene = nullptr;
    const GpuRadiance* radiance = nullptr;  ///< of the same vertices
    Affine3d worldFromObject{};             ///< a rotation and a shift
};

struct GpuViewOptions {
    const GpuBackground* background = nullptr;  ///< seen where no surface is; black without
    Mat3d worldFromBackground{};                ///< a rotation: L(R⁻¹ω)
    const GpuMirrors* mirrors = nullptr;        ///< what mirror-like surfaces show of the light
    PixelColumns columns{};         ///< that are drawn; the camera sees the whole width as ever
    Vec2f shiftPixels{0.0f, 0.0f};  ///< how far right and up of its middle a pixel looks
    bool wireFrame = false;      ///< the visible edges of triangles are drawn over their surfaces
    float wireRadiance = 0.18f;  ///< what is brighter gets dark lines, what is darker bright ones
};

/// Draws a picture of relit scenes, as renderView makes it: linear radiance, unclamped. Differs: a
/// pixel is what its centre shows, or the mean of as many places as the target has samples; and
/// what lies nearer than a thousandth of the farthest point is not seen.
///
/// Leaves depth test, culling, program, textures and buffers as it needs them.
///
/// @param objects  relit under the same light, each in its own frame
/// @param camera   world space
/// @param target   of floats
/// @throws Error   invalidOption for a field of view out of range
void drawGpuView(std::span<const GpuObject> objects, const Camera& camera, const GpuTarget& target,
                 const GpuViewOptions& options = {});

}  // namespace prt
