#include "prt/render/render_view.h"

#include <vector>

#include "prt/base/assert.h"
#include "prt/render/draw_view.h"
#include "prt/render/exit_shading.h"
#include "prt/render/path_walk.h"
#include "prt/scene/surface_color.h"

namespace prt {
namespace {

/// What is given for every vertex of a scene, mesh by mesh.
template <class Value>
class VertexValues {
  public:
    VertexValues(const Scene& scene, std::span<const Value> values)
        : values_(values), offsets_(vertexOffsets(scene)) {
        PRT_ASSERT(values.size() == scene.vertexCount(), "one radiance a vertex");
    }

    std::span<const Value> ofMesh(std::size_t mesh) const {
        return values_.subspan(offsets_[mesh], offsets_[mesh + 1] - offsets_[mesh]);
    }

  private:
    std::span<const Value> values_;
    std::vector<std::size_t> offsets_;
};

}  // namespace

Image renderView(const Scene& scene, const RayScene& rays, std::span<const Vec3f> vertexRadiance,
                 const Camera& camera, const RenderOptions& options) {
    const VertexValues<Vec3f> radiance(scene, vertexRadiance);
    return drawView(scene, rays, camera, options, [&](const SeenPoint& seen) {
        const SurfacePoint& point = seen.hit.point;
        return evaluateAlbedo(scene, point) * interpolateCorners(scene.meshes[point.mesh], point,
                                                                 radiance.ofMesh(point.mesh)) +
               evaluateEmission(scene, point);
    });
}

Image renderView(const Scene& scene, const RayScene& rays,
                 std::span<const ExitRadiance> vertexRadiance, const Camera& camera,
                 const RenderOptions& options) {
    const VertexValues<ExitRadiance> radiance(scene, vertexRadiance);
    return drawView(scene, rays, camera, options, [&](const SeenPoint& seen) {
        const SurfacePoint& point = seen.hit.point;
        const ExitRadiance exit =
            interpolateExit(scene.meshes[point.mesh], point, radiance.ofMesh(point.mesh));
        const Vec3f normal = placePathOrigin(scene, rays, seen.hit).normal;
        return shadePoint(scene, point, exit, normal, -seen.direction, options.mirrors) +
               evaluateEmission(scene, point);
    });
}

}  // namespace prt
