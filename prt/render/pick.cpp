#include "prt/render/pick.h"

#include <algorithm>
#include <cstdint>
#include <span>

#include "prt/render/camera_rays.h"

namespace prt {
namespace {

/// The camera as an object that was moved sees it.
Camera moveCamera(Camera camera, const Affine3d& worldFromObject) {
    const Mat3d objectFromWorld = worldFromObject.linear.transposed();
    camera.eye = Vec3f(objectFromWorld * (Vec3d(camera.eye) - worldFromObject.translation));
    camera.forward = objectFromWorld * camera.forward;
    camera.up = objectFromWorld * camera.up;
    return camera;
}

/// Of a point's triangle, numbered mesh after mesh.
std::size_t findNearestCorner(const Scene& scene, const SurfacePoint& point,
                              const Vec3f& position) {
    const Mesh& mesh = scene.meshes[point.mesh];
    const auto corners = std::span(mesh.indices).subspan(3 * point.triangle, 3);
    const auto nearest = std::ranges::min_element(
        corners, {}, [&](std::uint32_t i) { return (mesh.positions[i] - position).length2(); });
    return vertexOffsets(scene)[point.mesh] + *nearest;
}

}  // namespace

std::optional<PickedVertex> pickVertex(const Scene& scene, const RayScene& rays,
                                       const Camera& camera, const PicturePlace& place,
                                       const Affine3d& worldFromObject) {
    RenderOptions options;
    options.width = place.width;
    options.height = place.height;
    const Camera moved = moveCamera(camera, worldFromObject);
    const CameraRays cameraRays(scene, rays, moved, options);
    const bool isInside =
        place.x >= 0.0 && place.x <= place.width && place.y >= 0.0 && place.y <= place.height;
    if (!isInside) return std::nullopt;
    const SeenPoint seen = cameraRays.findSeenPoint(place.x, place.y);
    if (seen.hit.escaped) return std::nullopt;
    const SurfacePoint& point = seen.hit.point;
    const Vec3f position =
        interpolateCorners(scene.meshes[point.mesh], point,
                           std::span<const Vec3f>(scene.meshes[point.mesh].positions));
    return PickedVertex{findNearestCorner(scene, point, position), point,
                        (position - moved.eye).length()};
}

}  // namespace prt
