#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "prt/math/isa.h"
#include "prt/scene/scene.h"
#include "prt/scene/surface_color.h"
#include "prt/trace/ray_stream.h"

namespace prt {

/// A ray of length up to tFar, in world space.
struct Ray {
    Vec3f origin{0.0f, 0.0f, 0.0f};
    Vec3f direction{0.0f, 0.0f, 1.0f};  ///< not zero; need not be unit
    float tFar = std::numeric_limits<float>::infinity();
};

/// The first surface a ray meets.
struct Hit {
    bool escaped = true;  ///< it meets none: the rest means nothing
    float t = 0.0f;       ///< in units of the ray's direction
    SurfacePoint point;
    bool backFace = false;  ///< met from the side that the triangle's winding calls inside
};

struct RaySceneOptions {
    std::optional<Isa> isa{};  ///< pins the ray tracer's instruction set (C10)
    int threadCount = 0;       ///< for building the hierarchy; 0: one a core
};

/// The ray tracer that runs here and its version: another may round differently.
std::string rayTracerName();

/// A scene made ready for rays, watertight at edges at any size and place: it is recentred, and
/// scaled by a power of two to a radius of at most 1, before it is traced. Surfaces with an alpha
/// mask let rays through where they are cut out.
///
/// All queries may be made from many threads at once. A ray that is not finite is never traced.
class RayScene {
  public:
    /// @param scene  must outlive this; textures decoded
    explicit RayScene(const Scene& scene, const RaySceneOptions& options = {});
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// The first surface on the ray; escaped if the ray is not finite.
    Hit intersect(const Ray& ray) const;

    /// Many rays at once. @param hits  one a ray, written
    void intersect(std::span<const Ray> rays, std::span<Hit> hits) const;

    /// Whether anything stands on the ray; false if the ray is not finite.
    bool isOccluded(const Ray& ray) const;

    /// A world-space point in the tracer's own space, where ray streams and offsetRayOrigin live.
    /// Directions are the same in both.
    Vec3f tracePoint(const Vec3f& worldPoint) const;

    /// Finds which rays of a stream are blocked, marking them by tFar = −∞. Rays that are not
    /// finite count as blocked.
    ///
    /// @return  the number of rays that are not finite
    std::size_t findOccluded(RayStream& rays) const;

    /// The first surface on each of the given rays of a stream.
    ///
    /// @param rayIndices  into the stream
    /// @param hits        one an index, written
    void findClosest(const RayStream& rays, std::span<const std::uint32_t> rayIndices,
                     std::span<Hit> hits) const;

  private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace prt
