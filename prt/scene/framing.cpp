#include "prt/scene/framing.h"

#include <algorithm>
#include <cmath>

#include "prt/base/assert.h"

namespace prt {
namespace {

constexpr float kFramingFovRadians = 0.69813170079773179f;  // 40 degrees
constexpr double kFramingMargin = 1.05;

// From the target to the eye: a little to the right and above.
const Vec3d kFramingDirection(0.45, 0.4, 1.0);

// The distance from the centre at which a point, given relative to it,
// comes to lie on a side of the view.
double distanceToContain(const Vec3d& point, const Camera& camera, double aspectRatio) {
    const Vec3d forward = Vec3d(camera.forward);
    const Vec3d up = Vec3d(camera.up);
    const double tanVertical = std::tan(0.5 * static_cast<double>(camera.verticalFovRadians));
    const double sideways = std::abs(point.dot(forward.cross(up))) / (tanVertical * aspectRatio);
    const double upwards = std::abs(point.dot(up)) / tanVertical;
    return std::max(sideways, upwards) - point.dot(forward);
}

}  // namespace

Camera lookAt(const Vec3f& eye, const Vec3f& target, float verticalFovRadians) {
    PRT_ASSERT(verticalFovRadians > 0.0f && verticalFovRadians < 3.1415925f,
               "the field of view lies between 0 and pi");
    constexpr double kUpright =
        1e-6;  // sine of the angle from the vertical below which +y is no guide
    Vec3d forward = Vec3d(target) - Vec3d(eye);
    forward = forward.length() > 0.0 ? forward.normalized() : Vec3d(0.0, 0.0, -1.0);
    Vec3d right = forward.cross(Vec3d(0.0, 1.0, 0.0));
    if (right.length() < kUpright) right = forward.cross(Vec3d(0.0, 0.0, 1.0));
    const Vec3d up = right.normalized().cross(forward);

    Camera camera;
    camera.eye = eye;
    camera.forward = Vec3f(forward);
    camera.up = Vec3f(up);
    camera.verticalFovRadians = verticalFovRadians;
    return camera;
}

Camera frameScene(const Scene& scene, float aspectRatio) {
    return frameBounds(scene.vertexCount() > 0 ? computeBounds(scene) : Bounds{}, aspectRatio);
}

Camera frameBounds(const Bounds& bounds, float aspectRatio) {
    PRT_ASSERT(aspectRatio > 0.0f && std::isfinite(aspectRatio),
               "a picture has a width and a height");
    const Vec3d center = (Vec3d(bounds.low) + Vec3d(bounds.high)) * 0.5;
    const Vec3d halfSize = (Vec3d(bounds.high) - Vec3d(bounds.low)) * 0.5;
    Camera camera = lookAt(Vec3f(kFramingDirection), Vec3f(0.0f), kFramingFovRadians);
    camera.name = "framed";

    // Step back until the last of the eight corners is in view.
    double distance = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d signs((corner & 1) ? 1.0 : -1.0, (corner & 2) ? 1.0 : -1.0,
                          (corner & 4) ? 1.0 : -1.0);
        distance = std::max(distance, distanceToContain(halfSize * signs, camera,
                                                        static_cast<double>(aspectRatio)));
    }
    if (distance <= 0.0) distance = 1.0;  // a single point: any distance shows it
    camera.eye = Vec3f(center - Vec3d(camera.forward) * (distance * kFramingMargin));
    return camera;
}

}  // namespace prt
