#include "prt/render/path_traced_view.h"

#include <algorithm>
#include <vector>

#include "prt/render/camera_rays.h"
#include "prt/scene/surface_color.h"

namespace prt {
namespace {

/// Pixels whose paths are held in memory at once.
constexpr std::size_t kBlockPixels = 1024;

/// Traces and adds up the pixels of one block of a view.
class BlockTracer {
  public:
    BlockTracer(const Scene& scene, const RayScene& rays, const RenderOptions& view,
                std::vector<SeenPoint> seen)
        : scene_(scene), rays_(rays), view_(view), seen_(std::move(seen)) {}

    /// What the surfaces seen reflect towards the eye, in the order of the rays that see one.
    RadianceEstimate estimateReflected(const DistantLight& light, int samplesPerRay,
                                       const PathTracerOptions& options) const {
        if (options.walk.surfaceModel == SurfaceModel::gltf)
            return estimateExitRadiance(scene_, rays_, light, placeExitPoints(options.walk),
                                        samplesPerRay, options);
        RadianceEstimate estimate =
            estimateRadiance(scene_, rays_, light, placeOrigins(), samplesPerRay, options);
        std::size_t origin = 0;
        for (const SeenPoint& seen : seen_) {
            if (seen.hit.escaped) continue;
            const Vec3d albedo(evaluateAlbedo(scene_, seen.hit.point));
            estimate.mean[origin] *= albedo;
            estimate.variance[origin++] *= albedo * albedo;
        }
        return estimate;
    }

    /// @param estimate  of what is reflected
    void addUp(const RadianceEstimate& estimate, std::span<Vec3f> radiance,
               std::span<Vec3f> variance) const {
        const std::size_t raysPerPixel = seen_.size() / radiance.size();
        const auto rayCount = static_cast<double>(raysPerPixel);
        std::size_t origin = 0;
        for (std::size_t pixel = 0; pixel < radiance.size(); ++pixel) {
            Vec3d sum(0.0), varianceSum(0.0);
            for (std::size_t i = pixel * raysPerPixel; i < (pixel + 1) * raysPerPixel; ++i) {
                const SeenPoint& seen = seen_[i];
                if (seen.hit.escaped) {
                    sum += Vec3d(lookUpBackground(view_, seen.direction));
                    continue;
                }
                sum += estimate.mean[origin] + Vec3d(evaluateEmission(scene_, seen.hit.point));
                varianceSum += estimate.variance[origin++];
            }
            radiance[pixel] = Vec3f(sum / rayCount);
            variance[pixel] = Vec3f(varianceSum / (rayCount * rayCount));
        }
    }

  private:
    std::vector<PathOrigin> placeOrigins() const {
        std::vector<PathOrigin> origins;
        for (const SeenPoint& seen : seen_)
            if (!seen.hit.escaped) origins.push_back(placePathOrigin(scene_, rays_, seen.hit));
        return origins;
    }

    std::vector<ExitPoint> placeExitPoints(const WalkOptions& options) const {
        std::vector<ExitPoint> points;
        for (const SeenPoint& seen : seen_) {
            if (seen.hit.escaped) continue;
            const PathOrigin origin = placePathOrigin(scene_, rays_, seen.hit);
            points.push_back({origin, makeReflection(findBrdf(scene_, seen.hit.point, options),
                                                     origin.normal, -seen.direction)});
        }
        return points;
    }

    const Scene& scene_;
    const RayScene& rays_;
    const RenderOptions& view_;
    std::vector<SeenPoint> seen_;
};

}  // namespace

PathTracedView pathTraceView(const Scene& scene, const RayScene& rays, const DistantLight& light,
                             const Camera& camera, const RenderOptions& view, int samplesPerRay,
                             const PathTracerOptions& options) {
    const CameraRays cameraRays(scene, rays, camera, view);
    PathTracedView result{Image(view.width, view.height), Image(view.width, view.height)};
    const std::size_t pixelCount = result.radiance.pixels.size();
    for (std::size_t begin = 0; begin < pixelCount; begin += kBlockPixels) {
        const std::size_t count = std::min(kBlockPixels, pixelCount - begin);
        // Report the part of all pixels that the part of this block amounts to.
        PathTracerOptions blockOptions = options;
        blockOptions.firstStream = begin * cameraRays.raysPerPixel();
        blockOptions.progress = [&](const Progress& block) {
            const std::uint64_t done = block.total > 0 ? count * block.done / block.total : count;
            return !options.progress ||
                   options.progress({"path-trace", "pixels", begin + done, pixelCount});
        };
        const BlockTracer tracer(scene, rays, view, cameraRays.findSeenPoints(begin, count));
        tracer.addUp(tracer.estimateReflected(light, samplesPerRay, blockOptions),
                     std::span(result.radiance.pixels).subspan(begin, count),
                     std::span(result.variance.pixels).subspan(begin, count));
    }
    return result;
}

}  // namespace prt
