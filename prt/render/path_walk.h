#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "prt/base/random.h"
#include "prt/render/reflection.h"
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

/// What surfaces that paths meet are taken for.
enum class SurfaceModel {
    diffuse,  ///< base colour over π, metallic or not, as in transfer vectors
    gltf,     ///< the metallic-roughness BRDF (makeGltfBrdf)
};

struct WalkOptions {
    SurfaceModel surfaceModel = SurfaceModel::diffuse;
    /// With the glTF model: BRDFs in place of those of the scene's materials, one a material. Where
    /// one has no lobe, the material stays as it is.
    std::span<const Brdf> materialBrdfs{};

    int bounceCount = kUnlimitedBounces;  ///< indirect bounces (C8)
    bool roulette =
        true;  ///< ends dark paths early and makes up for it; must be on without a limit

    /// Origins at the vertices of the scene, numbered mesh after mesh, and those of their other
    /// sides. Given these, a path that meets a triangle goes on from one of its corners, drawn with
    /// its barycentric weight: its mean then is the transfer that is linear between vertices, which
    /// a bake solves for [Goral84]. What the surface is made of stays that of the point it met.
    /// Without them it goes on from where it met the triangle.
    std::span<const PathOrigin> vertexFronts{};
    std::span<const PathOrigin> vertexBacks{};  ///< needed where a material is double-sided
};

/// The BRDF of a point of a surface, by the model of the options.
Brdf findBrdf(const Scene& scene, const SurfacePoint& point, const WalkOptions& options);

/// A path at one of its surface points.
struct Path {
    std::size_t index = 0;  ///< of the path among those that walk together
    RandomStream random{0, 0};
    PathOrigin at;
    /// How the point reflects back along the path; none: as 1/π, its albedo being elsewhere.
    std::optional<Reflection> reflection{};
    /// Product of what the surfaces reflect of what they draw, over the odds of survival.
    Vec3f throughput{1.0f, 1.0f, 1.0f};
    int bounceCount = 0;
    double density = 0.0;  ///< per steradian, of the direction that it leaves the point by
};

/// What the point of a path makes of light from a direction.
///
/// @param direction  unit, world space
Scattering evaluateScattering(const Path& path, const Vec3f& direction);

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
/// nothing, or made all its bounces. Of diffuse points directions follow the cosine about the
/// shading normal, so the cosine and the 1/π of reflection cancel [Pharr23, 13.6]; of others they
/// are drawn by the BRDF. The back of a one-sided surface ends a path; a direction below the
/// geometric surface meets that surface (C11).
void walkPaths(const Scene& scene, const RayScene& rays, const WalkOptions& options,
               std::vector<Path> paths, PathVisitor& visitor);

}  // namespace prt
