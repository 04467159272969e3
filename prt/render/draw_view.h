#pragma once

#include <functional>

#include "prt/render/camera_rays.h"

namespace prt {

/// Radiance that comes to the eye from the surface that a ray has met.
using SurfaceShader = std::function<Vec3f(const SeenPoint& seen)>;

/// A picture whose pixels are the mean over their rays: of what the shader says where they meet a
/// surface, and of the background elsewhere.
///
/// @param shade   called by many threads at once
/// @throws Error  as renderView
Image drawView(const Scene& scene, const RayScene& rays, const Camera& camera,
               const RenderOptions& options, const SurfaceShader& shade);

}  // namespace prt
