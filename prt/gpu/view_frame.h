#pragma once

#include <cmath>

#include "prt/math/transform.h"
#include "prt/scene/scene.h"

namespace prt {

/// What a camera sees at unit distance along its axis, world space.
struct ViewFrame {
    Vec3d forward;    ///< unit, to the middle of the picture
    Vec3d rightward;  ///< from there to its right edge
    Vec3d upward;     ///< and to its upper one
    /// What the picture shows is as far to the right of this, and above, in the same units.
    double rightwardShift = 0.0;
    double upwardShift = 0.0;
};

/// @param aspectRatio  width over height
inline ViewFrame makeViewFrame(const Camera& camera, double aspectRatio) {
    const double halfHeight = std::tan(0.5 * static_cast<double>(camera.verticalFovRadians));
    const Vec3d forward(camera.forward);
    const Vec3d up(camera.up);
    return {forward, forward.cross(up) * (halfHeight * aspectRatio), up * halfHeight};
}

/// A view along the axes of something that was turned.
inline ViewFrame turnView(const ViewFrame& view, const Mat3d& turnedFromWorld) {
    return {turnedFromWorld * view.forward, turnedFromWorld * view.rightward,
            turnedFromWorld * view.upward, view.rightwardShift, view.upwardShift};
}

}  // namespace prt
