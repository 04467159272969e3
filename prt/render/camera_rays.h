#pragma once

#include <cstddef>
#include <vector>

#include "prt/render/render_view.h"
#include "prt/scene/scene.h"
#include "prt/trace/ray_scene.h"

namespace prt {

/// What one ray from the eye sees.
struct SeenPoint {
    Vec3f direction{0.0f, 0.0f, -1.0f};  ///< of the ray, unit
    Hit hit;                             ///< escaped where there is no visible surface
};

/// What a ray that meets no surface sees: the view's background as it is turned, or black.
///
/// @param direction  unit
Vec3f lookUpBackground(const RenderOptions& view, const Vec3f& direction);

/// The rays of a view: samplesPerAxis² a pixel, jittered in as many strata, all of the same weight.
/// Views of the same options, whatever they show, look along the same rays.
class CameraRays {
  public:
    /// @param scene, rays  must outlive this
    /// @throws Error       invalidOption for a size, sample count or field of view out of range
    CameraRays(const Scene& scene, const RayScene& rays, const Camera& camera,
               const RenderOptions& options);

    std::size_t raysPerPixel() const;

    /// Follows the rays of some pixels, row-major numbers from `firstPixel` on, past the backs of
    /// one-sided surfaces to what they see; pixel after pixel.
    std::vector<SeenPoint> findSeenPoints(std::size_t firstPixel, std::size_t pixelCount) const;

    /// The same of one ray, through a place on the picture in pixels from its top left corner.
    SeenPoint findSeenPoint(double x, double y) const;

  private:
    /// Unit direction through a place on the picture, in pixels from its top left corner.
    Vec3f directionThrough(double x, double y) const;
    std::vector<SeenPoint> followRays(std::vector<Ray> rays) const;
    std::vector<Ray> makeRays(std::size_t firstPixel, std::size_t pixelCount) const;
    void passBackFaces(std::vector<Ray>& rays, std::vector<Hit>& hits) const;
    bool isInvisible(const Hit& hit) const;

    const Scene& scene_;
    const RayScene& rays_;
    std::uint64_t seed_;
    int samplesPerAxis_;
    std::size_t width_;
    Vec3f eye_;
    Vec3d middle_;
    Vec3d forward_;
    Vec3d right_;  ///< the width of a pixel at unit distance
    Vec3d up_;
};

}  // namespace prt
