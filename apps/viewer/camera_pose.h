#pragma once

#include "prt/scene/scene.h"

namespace prt::viewer {

/// A camera that looks at a point from somewhere around it, +y up.
struct CameraPose {
    Vec3d target{0.0, 0.0, 0.0};    ///< metres, world space
    double distance = 1.0;          ///< from there to the eye, metres
    double azimuthDegrees = 0.0;    ///< of the eye seen from the target, from +z towards +x
    double elevationDegrees = 0.0;  ///< of the eye above the target's horizon, −90 … 90
    double fovDegrees = 40.0;       ///< vertical
};

/// Pictures of the pose. @param pose  finite, its field of view between 0 and 180 degrees
Camera makeCamera(const CameraPose& pose);

/// The pose that sees what a camera sees; a camera that is tilted sideways comes upright.
///
/// @param distance  to what the pose is to turn about
CameraPose poseFromCamera(const Camera& camera, double distance);

/// Around the target; elevation stops just short of the poles.
CameraPose orbit(const CameraPose& pose, double azimuthDegrees, double elevationDegrees);

/// Eye and target move along the picture.
///
/// @param rightward, upward  in heights of the picture at the target's distance
CameraPose pan(const CameraPose& pose, double rightward, double upward);

/// Towards the target, or away from it. @param factor  of the distance, positive
CameraPose zoom(const CameraPose& pose, double factor);

/// Eye and target move as if one walked.
///
/// @param forward, rightward, upward  in distances from eye to target
CameraPose fly(const CameraPose& pose, double forward, double rightward, double upward);

/// The eye stays, the target goes around it.
CameraPose lookAround(const CameraPose& pose, double azimuthDegrees, double elevationDegrees);

}  // namespace prt::viewer
