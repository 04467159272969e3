#include "prt/render/camera_rays.h"

#include <cmath>
#include <numbers>
#include <string>

#include "prt/base/error.h"
#include "prt/base/random.h"

namespace prt {
namespace {

constexpr int kMaxImageSide = 32768;
constexpr int kMaxSamplesPerAxis = 64;

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

}  // namespace

Vec3f lookUpBackground(const RenderOptions& view, const Vec3f& direction) {
    if (!view.background) return Vec3f(0.0f);
    return lookUpRadiance(*view.background, view.worldFromBackground.transposed() * direction);
}

CameraRays::CameraRays(const Scene& scene, const RayScene& rays, const Camera& camera,
                       const RenderOptions& options)
    : scene_(scene),
      rays_(rays),
      seed_(options.seed),
      samplesPerAxis_(options.samplesPerAxis),
      width_(static_cast<std::size_t>(options.width)),
      eye_(camera.eye),
      middle_(0.5 * options.width, 0.5 * options.height, 0.0),
      forward_(camera.forward) {
    checkView(camera, options);
    const double halfFov = 0.5 * static_cast<double>(camera.verticalFovRadians);
    const double perPixel = 2.0 * std::tan(halfFov) / options.height;
    right_ = forward_.cross(Vec3d(camera.up)) * perPixel;
    up_ = Vec3d(camera.up) * perPixel;
}

std::size_t CameraRays::raysPerPixel() const {
    return static_cast<std::size_t>(samplesPerAxis_ * samplesPerAxis_);
}

std::vector<SeenPoint> CameraRays::findSeenPoints(std::size_t firstPixel,
                                                  std::size_t pixelCount) const {
    return followRays(makeRays(firstPixel, pixelCount));
}

SeenPoint CameraRays::findSeenPoint(double x, double y) const {
    return followRays({{eye_, directionThrough(x, y)}}).front();
}

std::vector<SeenPoint> CameraRays::followRays(std::vector<Ray> rays) const {
    std::vector<Hit> hits(rays.size());
    rays_.intersect(rays, hits);
    passBackFaces(rays, hits);

    std::vector<SeenPoint> points(rays.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = {rays[i].direction, isInvisible(hits[i]) ? Hit() : hits[i]};
    return points;
}

Vec3f CameraRays::directionThrough(double x, double y) const {
    const Vec3d sideways = right_ * (x - middle_.x);
    const Vec3d upwards = up_ * (middle_.y - y);
    return Vec3f((forward_ + sideways + upwards).normalized());
}

std::vector<Ray> CameraRays::makeRays(std::size_t firstPixel, std::size_t pixelCount) const {
    const int n = samplesPerAxis_;
    std::vector<Ray> rays;
    rays.reserve(pixelCount * raysPerPixel());
    for (std::size_t pixel = firstPixel; pixel < firstPixel + pixelCount; ++pixel) {
        RandomStream random(seed_, pixel);
        const auto left = static_cast<double>(pixel % width_);
        const auto top = static_cast<double>(pixel / width_);
        for (int row = 0; row < n; ++row) {
            for (int column = 0; column < n; ++column) {
                const double x = left + (column + random.nextUnitDouble()) / n;
                const double y = top + (row + random.nextUnitDouble()) / n;
                rays.push_back({eye_, directionThrough(x, y)});
            }
        }
    }
    return rays;
}

/// Sends rays on that met a one-sided surface from behind, until they meet a visible one.
void CameraRays::passBackFaces(std::vector<Ray>& rays, std::vector<Hit>& hits) const {
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
        rays_.intersect(onward, met);
        for (std::size_t i = 0; i < passing.size(); ++i)
            hits[passing[i]] = met[i];
    }
}

bool CameraRays::isInvisible(const Hit& hit) const {
    if (hit.escaped || !hit.backFace) return false;
    return !scene_.materials[scene_.meshes[hit.point.mesh].material].doubleSided;
}

}  // namespace prt
