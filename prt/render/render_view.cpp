#include "prt/render/render_view.h"

#include <vector>

#include "prt/base/assert.h"
#include "prt/parallel/parallel_for.h"
#include "prt/render/camera_rays.h"
#include "prt/scene/surface_color.h"

namespace prt {
namespace {

/// Pixels a task.
constexpr std::size_t kChunkPixels = 64;

class ViewRenderer {
  public:
    ViewRenderer(const Scene& scene, const RayScene& rayScene,
                 std::span<const Vec3f> vertexRadiance, const Camera& camera,
                 const RenderOptions& options)
        : scene_(scene),
          cameraRays_(scene, rayScene, camera, options),
          vertexRadiance_(vertexRadiance),
          vertexOffsets_(vertexOffsets(scene)),
          options_(options) {
        PRT_ASSERT(vertexRadiance.size() == scene.vertexCount(), "one radiance a vertex");
    }

    /// @param firstPixel  row-major number of the first of the pixels to write
    void renderPixels(std::size_t firstPixel, std::span<Vec3f> pixels) const {
        const std::vector<SeenPoint> seen = cameraRays_.findSeenPoints(firstPixel, pixels.size());
        const std::size_t rayCount = cameraRays_.raysPerPixel();
        for (std::size_t pixel = 0; pixel < pixels.size(); ++pixel) {
            Vec3d sum(0.0);
            for (std::size_t i = pixel * rayCount; i < (pixel + 1) * rayCount; ++i)
                sum += Vec3d(seenRadiance(seen[i]));
            pixels[pixel] = Vec3f(sum / static_cast<double>(rayCount));
        }
    }

  private:
    Vec3f seenRadiance(const SeenPoint& seen) const {
        if (seen.hit.escaped) return lookUpBackground(options_, seen.direction);
        const SurfacePoint& point = seen.hit.point;
        const Mesh& mesh = scene_.meshes[point.mesh];
        const auto meshRadiance =
            vertexRadiance_.subspan(vertexOffsets_[point.mesh], mesh.vertexCount());
        return evaluateAlbedo(scene_, point) * interpolateCorners(mesh, point, meshRadiance) +
               evaluateEmission(scene_, point);
    }

    const Scene& scene_;
    CameraRays cameraRays_;
    std::span<const Vec3f> vertexRadiance_;
    std::vector<std::size_t> vertexOffsets_;
    const RenderOptions& options_;
};

}  // namespace

Image renderView(const Scene& scene, const RayScene& rays, std::span<const Vec3f> vertexRadiance,
                 const Camera& camera, const RenderOptions& options) {
    const ViewRenderer renderer(scene, rays, vertexRadiance, camera, options);
    Image image(options.width, options.height);
    ProgressReporter progress(options.progress, "render", "pixels", image.pixels.size());
    parallelFor(image.pixels.size(), {options.threadCount, kChunkPixels},
                [&](std::size_t begin, std::size_t end) {
                    renderer.renderPixels(begin,
                                          std::span(image.pixels).subspan(begin, end - begin));
                    progress.advance(end - begin);
                });
    return image;
}

}  // namespace prt
