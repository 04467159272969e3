#include "prt/render/render_view.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/base/random.h"
#include "prt/parallel/parallel_for.h"
#include "prt/scene/surface_color.h"

namespace prt {
namespace {

constexpr int kMaxImageSide = 32768;
constexpr int kMaxSamplesPerAxis = 64;

/// Pixels a task.
constexpr std::size_t kChunkPixels = 64;

/// Surfaces that one ray may pass from behind.
constexpr int kMaxPassedSurfaces = 64;

/// How far behind a passed surface a ray goes on, relative to its distance from the eye: more than
/// the rounding of positions, and a hundredth of a usual pixel.
constexpr float kPassedStep = 1e-5f;

void checkRange(int value, int maximum, const char* what) {
    if (value >= 1 && value <= maximum) return;
    throw Error(ErrorCode::invalidOption, std::string(what) + " is " + std::to_string(value) +
                                              ", not between 1 and " + std::to_string(maximum));
}

void checkView(const Camera& camera, const RenderOptions& options) {
    checkRange(options.width, kMaxImageSide, "the width");
    checkRange(options.height, kMaxImageSide, "the height");
    checkRange(options.samplesPerAxis, kMaxSamplesPerAxis, "the number of samples per axis");
    const float fov = camera.verticalFovRadians;
    if (!(fov > 0.0f && fov < std::numbers::pi_v<float>))
        throw Error(ErrorCode::invalidOption, "the field of view is not between 0 and 180 degrees");
}

/// Turns places on a picture, in pixels from its top left corner,
/// into unit directions from the eye.
class Pinhole {
  public:
    Pinhole(const Camera& camera, int width, int height)
        : perPixel_(2.0 * std::tan(0.5 * static_cast<double>(camera.verticalFovRadians)) / height),
          middle_(0.5 * width, 0.5 * height, 0.0),
          forward_(camera.forward),
          right_(Vec3d(camera.forward).cross(Vec3d(camera.up))),
          up_(camera.up) {}

    Vec3f direction(double x, double y) const {
        const Vec3d sideways = right_ * ((x - middle_.x) * perPixel_);
        const Vec3d upwards = up_ * ((middle_.y - y) * perPixel_);
        return Vec3f((forward_ + sideways + upwards).normalized());
    }

  private:
    double perPixel_;
    Vec3d middle_;
    Vec3d forward_;
    Vec3d right_;
    Vec3d up_;
};

class ViewRenderer {
  public:
    ViewRenderer(const Scene& scene, const RayScene& rayScene,
                 std::span<const Vec3f> vertexRadiance, const Camera& camera,
                 const RenderOptions& options)
        : scene_(scene),
          rayScene_(rayScene),
          vertexRadiance_(vertexRadiance),
          vertexOffsets_(vertexOffsets(scene)),
          eye_(camera.eye),
          pinhole_(camera, options.width, options.height),
          options_(options) {
        PRT_ASSERT(vertexRadiance.size() == scene.vertexCount(), "one radiance a vertex");
    }

    /// @param firstPixel  row-major number of the first of the pixels to write
    void renderPixels(std::size_t firstPixel, std::span<Vec3f> pixels) const {
        std::vector<Ray> rays = makeRays(firstPixel, pixels.size());
        std::vector<Hit> hits(rays.size());
        rayScene_.intersect(rays, hits);
        passBackFaces(rays, hits);

        const std::size_t sampleCount = rays.size() / pixels.size();
        for (std::size_t pixel = 0; pixel < pixels.size(); ++pixel) {
            Vec3d sum(0.0);
            for (std::size_t i = pixel * sampleCount; i < (pixel + 1) * sampleCount; ++i)
                sum += Vec3d(seenRadiance(rays[i].direction, hits[i]));
            pixels[pixel] = Vec3f(sum / static_cast<double>(sampleCount));
        }
    }

  private:
    std::vector<Ray> makeRays(std::size_t firstPixel, std::size_t pixelCount) const {
        const int n = options_.samplesPerAxis;
        const auto width = static_cast<std::size_t>(options_.width);
        std::vector<Ray> rays;
        rays.reserve(pixelCount * static_cast<std::size_t>(n * n));
        for (std::size_t pixel = firstPixel; pixel < firstPixel + pixelCount; ++pixel) {
            RandomStream random(options_.seed, pixel);
            const auto left = static_cast<double>(pixel % width);
            const auto top = static_cast<double>(pixel / width);
            for (int row = 0; row < n; ++row) {
                for (int column = 0; column < n; ++column) {
                    const double x = left + (column + random.nextUnitDouble()) / n;
                    const double y = top + (row + random.nextUnitDouble()) / n;
                    rays.push_back({eye_, pinhole_.direction(x, y)});
                }
            }
        }
        return rays;
    }

    /// Sends rays on that met a one-sided surface from behind, until they meet a visible one.
    void passBackFaces(std::span<Ray> rays, std::span<Hit> hits) const {
        std::vector<std::size_t> passing;
        std::vector<Ray> onward;
        std::vector<Hit> met;
        for (int passed = 0; passed < kMaxPassedSurfaces; ++passed) {
            passing.clear();
            onward.clear();
            for (std::size_t i = 0; i < rays.size(); ++i) {
                if (!isInvisible(hits[i])) continue;
                const Vec3f& direction = rays[i].direction;
                const float distance = (rays[i].origin - eye_).dot(direction) + hits[i].t;
                rays[i].origin = eye_ + direction * (distance * (1.0f + kPassedStep));
                passing.push_back(i);
                onward.push_back(rays[i]);
            }
            if (passing.empty()) return;
            met.resize(passing.size());
            rayScene_.intersect(onward, met);
            for (std::size_t i = 0; i < passing.size(); ++i)
                hits[passing[i]] = met[i];
        }
    }

    bool isInvisible(const Hit& hit) const {
        if (hit.escaped || !hit.backFace) return false;
        return !scene_.materials[scene_.meshes[hit.point.mesh].material].doubleSided;
    }

    Vec3f seenRadiance(const Vec3f& direction, const Hit& hit) const {
        if (hit.escaped || isInvisible(hit)) {
            return options_.background ? lookUpRadiance(*options_.background, direction)
                                       : Vec3f(0.0f);
        }
        const Mesh& mesh = scene_.meshes[hit.point.mesh];
        const auto meshRadiance =
            vertexRadiance_.subspan(vertexOffsets_[hit.point.mesh], mesh.vertexCount());
        const Vec4f albedo = evaluateBaseColor(scene_, hit.point);
        return Vec3f(albedo.x, albedo.y, albedo.z) *
                   interpolateCorners(mesh, hit.point, meshRadiance) +
               evaluateEmission(scene_, hit.point);
    }

    const Scene& scene_;
    const RayScene& rayScene_;
    std::span<const Vec3f> vertexRadiance_;
    std::vector<std::size_t> vertexOffsets_;
    Vec3f eye_;
    Pinhole pinhole_;
    const RenderOptions& options_;
};

}  // namespace

Image renderView(const Scene& scene, const RayScene& rays, std::span<const Vec3f> vertexRadiance,
                 const Camera& camera, const RenderOptions& options) {
    checkView(camera, options);
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
