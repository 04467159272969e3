#include "apps/viewer/camera_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/scene/framing.h"

namespace prt::viewer {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Straight up and down have no azimuth.
constexpr double kMostElevationDegrees = 89.9;

/// From the target to the eye, unit.
Vec3d directionOf(const CameraPose& pose) {
    const double azimuth = pose.azimuthDegrees * kDegree;
    const double elevation = pose.elevationDegrees * kDegree;
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
            std::cos(elevation) * std::cos(azimuth)};
}

Vec3d eyeOf(const CameraPose& pose) {
    return pose.target + directionOf(pose) * pose.distance;
}

Vec3d rightOf(const CameraPose& pose) {
    const double azimuth = pose.azimuthDegrees * kDegree;
    return {std::cos(azimuth), 0.0, -std::sin(azimuth)};
}

/// Both ends move.
CameraPose moveBy(CameraPose pose, const Vec3d& step) {
    pose.target += step;
    return pose;
}

}  // namespace

Camera makeCamera(const CameraPose& pose) {
    return lookAt(Vec3f(eyeOf(pose)), Vec3f(pose.target),
                  static_cast<float>(pose.fovDegrees * kDegree));
}

CameraPose poseFromCamera(const Camera& camera, double distance) {
    const Vec3d toEye = -Vec3d(camera.forward);
    CameraPose pose;
    pose.target = Vec3d(camera.eye) - toEye * distance;
    pose.distance = distance;
    pose.azimuthDegrees = std::atan2(toEye.x, toEye.z) / kDegree;
    pose.elevationDegrees = std::asin(std::clamp(toEye.y, -1.0, 1.0)) / kDegree;
    pose.fovDegrees = static_cast<double>(camera.verticalFovRadians) / kDegree;
    return orbit(pose, 0.0, 0.0);
}

CameraPose orbit(const CameraPose& pose, double azimuthDegrees, double elevationDegrees) {
    CameraPose turned = pose;
    turned.azimuthDegrees = std::remainder(pose.azimuthDegrees + azimuthDegrees, 360.0);
    turned.elevationDegrees = std::clamp(pose.elevationDegrees + elevationDegrees,
                                         -kMostElevationDegrees, kMostElevationDegrees);
    return turned;
}

CameraPose pan(const CameraPose& pose, double rightward, double upward) {
    const double height = 2.0 * pose.distance * std::tan(0.5 * pose.fovDegrees * kDegree);
    const Vec3d right = rightOf(pose);
    const Vec3d up = directionOf(pose).cross(right);
    return moveBy(pose, (right * rightward + up * upward) * height);
}

CameraPose zoom(const CameraPose& pose, double factor) {
    CameraPose nearer = pose;
    nearer.distance *= factor;
    return nearer;
}

CameraPose fly(const CameraPose& pose, double forward, double rightward, double upward) {
    const Vec3d direction = directionOf(pose);
    const Vec3d right = rightOf(pose);
    const Vec3d up = direction.cross(right);
    return moveBy(pose, (right * rightward + up * upward - direction * forward) * pose.distance);
}

CameraPose lookAround(const CameraPose& pose, double azimuthDegrees, double elevationDegrees) {
    CameraPose turned = orbit(pose, azimuthDegrees, elevationDegrees);
    turned.target = eyeOf(pose) - directionOf(turned) * pose.distance;
    return turned;
}

}  // namespace prt::viewer
