#include "prt/render/draw_view.h"

#include <span>
#include <vector>

#include "prt/parallel/parallel_for.h"

namespace prt {
namespace {

/// Pixels a task.
constexpr std::size_t kChunkPixels = 64;

}  // namespace

Image drawView(const Scene& scene, const RayScene& rays, const Camera& camera,
               const RenderOptions& options, const SurfaceShader& shade) {
    const CameraRays cameraRays(scene, rays, camera, options);
    const std::size_t rayCount = cameraRays.raysPerPixel();
    const auto drawPixels = [&](std::size_t firstPixel, std::span<Vec3f> pixels) {
        const std::vector<SeenPoint> seen = cameraRays.findSeenPoints(firstPixel, pixels.size());
        for (std::size_t pixel = 0; pixel < pixels.size(); ++pixel) {
            Vec3d sum(0.0);
            for (std::size_t i = pixel * rayCount; i < (pixel + 1) * rayCount; ++i)
                sum += Vec3d(seen[i].hit.escaped ? lookUpBackground(options, seen[i].direction)
                                                 : shade(seen[i]));
            pixels[pixel] = Vec3f(sum / static_cast<double>(rayCount));
        }
    };
    Image image(options.width, options.height);
    ProgressReporter progress(options.progress, "render", "pixels", image.pixels.size());
    parallelFor(image.pixels.size(), {options.threadCount, kChunkPixels},
                [&](std::size_t begin, std::size_t end) {
                    drawPixels(begin, std::span(image.pixels).subspan(begin, end - begin));
                    progress.advance(end - begin);
                });
    return image;
}

}  // namespace prt
