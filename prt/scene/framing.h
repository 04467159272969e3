#pragma once

#include "prt/scene/scene.h"

namespace prt {

/// A camera at `eye` that looks at `target`, +y up (or +z when looking straight up or down).
///
/// @param verticalFovRadians  in (0, π)
Camera lookAt(const Vec3f& eye, const Vec3f& target, float verticalFovRadians);

/// A camera that shows all of a box from the front, a little from the right and above.
///
/// @param aspectRatio  width over height of the picture to come
Camera frameBounds(const Bounds& bounds, float aspectRatio);

/// The same of a scene.
Camera frameScene(const Scene& scene, float aspectRatio);

}  // namespace prt
