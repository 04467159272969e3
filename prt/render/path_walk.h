#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/base/random.h"
#include "prt/scene/scene.h"
#include "prt/trace/ray_scene.h"

namespace prt {

/// A point that paths leave from, on one side of a surface.
struct PathOrigin {
    Vec3f position{0.0f, 0.0f, 0.0f};  ///< tracer's space (RayScene::tracePoint), off the surface
    Vec3f normal{0.0f, 1.0f, 0.0f};    ///< unit, of shading
};

/// Where paths leave a surface that a ray has met, on the side that was met.
PathOrigin placePathOrigin(const Scene& scene, const RayScene& rays, const Hit& hit);

/// Bounces without end.
inline constexpr int kUnlimitedBounces = -1;

struct WalkOptions {
    int bounceCount = kUnlimitedBounces;  ///< indirect bounces (C8)
    bool roulette =
        true;  ///< ends dark paths early and makes up for it; must be on without a limit

    /// Origins at the vertices of the scene, numbered mesh after mesh, and those of their other
    /// sides. Given these, a path that meets a triangle goes on from one of its corners, drawn with
    /// its barycentric weight: its mean then is the transfer that is linear between vertices, which
    /// a bake solves for [Goral84]. Without them it goes on from where it met the triangle.
    std::span<const PathOrigin> vertexFronts{};
    std::span<const PathOrigin> vertexBacks{};  ///< needed where a material is double-sided
};

/// A path at one of its surface points.
struct Path {
    std::size_t index = 0;  ///< of the path among those that walk together
    RandomStream random{0, 0};
    PathOrigin at;
    Vec3f throughput{1.0f, 1.0f, 1.0f};  ///< product of the albedos met, over the odds of survival
    int bounceCount = 0;
};

/// What becomes of the paths of a walk.
class PathVisitor {
  public:
    virtual ~PathVisitor() = default;
    /// At every surface point, the first included.
    virtual void arrive(std::span<Path> paths) = 0;
    /// Where a path leaves the scene.
    virtual void escape(const Path& path, const Vec3f& direction) = 0;
};

/// Walks paths from surface to surface until each has left the scene, met a surface that reflects
/// nothing, or made all its bounces. Directions follow the cosine about the shading normal, so the
/// cosine and the 1/π of diffuse reflection cancel [Pharr23, 13.6]. The back of a one-sided surface
/// ends a path; a direction below the geometric surface meets that surface (C11).
void walkPaths(const Scene& scene, const RayScene& rays, const WalkOptions& options,
               std::vector<Path> paths, PathVisitor& visitor);

}  // namespace prt
