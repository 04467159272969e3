// Bibliography
//   [Goral84]  Modeling the interaction of light between diffuse surfaces
//   [Arvo90]   Particle transport and image synthesis (Russian roulette)
//   [Pharr23]  Physically based rendering
#include "prt/render/path_walk.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "prt/base/assert.h"
#include "prt/math/frame.h"
#include "prt/math/sampling.h"
#include "prt/scene/normals.h"
#include "prt/scene/surface_color.h"
#include "prt/trace/ray_offset.h"

namespace prt {
namespace {

/// Roulette begins once the bright first bounces are made.
constexpr int kBouncesBeforeRoulette = 2;
/// Ends paths between perfect reflectors too.
constexpr float kHighestSurvival = 0.98f;

/// ⟨n, ω⟩/π, with which diffuse points draw their directions; negative below the horizon.
double cosineDensity(const Vec3f& normal, const Vec3f& direction) {
    return static_cast<double>(normal.dot(direction)) * std::numbers::inv_pi;
}

class Walk {
  public:
    Walk(const Scene& scene, const RayScene& rays, const WalkOptions& options)
        : scene_(scene), rays_(rays), options_(options) {
        PRT_ASSERT(
            options.materialBrdfs.empty() || options.materialBrdfs.size() == scene.materials.size(),
            "one BRDF a material");
        if (options.vertexFronts.empty()) return;
        vertexOffsets_ = vertexOffsets(scene);
        PRT_ASSERT(options.vertexFronts.size() == scene.vertexCount(), "one origin a vertex");
    }

    /// Takes every path one step further, and drops those that end.
    void step(std::vector<Path>& paths, PathVisitor& visitor) const {
        RayStream stream(paths.size());
        for (std::size_t i = 0; i < paths.size(); ++i)
            stream.setRay(i, paths[i].at.position, drawDirection(paths[i]));
        std::vector<std::uint32_t> all(paths.size());
        std::iota(all.begin(), all.end(), 0u);
        std::vector<Hit> hits(paths.size());
        rays_.findClosest(stream, all, hits);

        std::size_t keptCount = 0;
        for (std::size_t i = 0; i < paths.size(); ++i) {
            const Vec3f direction(stream.directionX[i], stream.directionY[i], stream.directionZ[i]);
            if (hits[i].escaped)
                visitor.escape(paths[i], direction);
            else if (scatter(paths[i], hits[i], direction))
                paths[keptCount++] = paths[i];
        }
        paths.erase(paths.begin() + static_cast<std::ptrdiff_t>(keptCount), paths.end());
    }

  private:
    static Vec3f drawDirection(Path& path) {
        if (path.reflection) {
            const double u = path.random.nextUnitDouble();
            const double v = path.random.nextUnitDouble();
            const ReflectedDirection drawn = drawReflected(*path.reflection, path.at.normal, u, v);
            path.throughput *= drawn.weight;
            path.density = drawn.density;
            return drawn.direction;
        }
        const float u = unitFloatFromBits(path.random.nextBits());
        const float v = unitFloatFromBits(path.random.nextBits());
        const Vec3f direction =
            frameFromNormal(path.at.normal).worldFromLocal(sampleCosineHemisphere(u, v));
        path.density = cosineDensity(path.at.normal, direction);
        return direction;
    }

    /// Whether the path goes on from the surface it has met.
    bool scatter(Path& path, const Hit& hit, const Vec3f& direction) const {
        if (path.bounceCount == options_.bounceCount) return false;
        const Material& material = scene_.materials[scene_.meshes[hit.point.mesh].material];
        if (hit.backFace && !material.doubleSided) return false;
        ++path.bounceCount;
        const bool isDiffuse = options_.surfaceModel == SurfaceModel::diffuse;
        if (isDiffuse) path.throughput *= evaluateAlbedo(scene_, hit.point);
        if (!survives(path)) return false;
        path.at = vertexOffsets_.empty() ? placePathOrigin(scene_, rays_, hit)
                                         : drawCorner(path.random, hit);
        path.reflection.reset();
        if (!isDiffuse)
            path.reflection =
                makeReflection(findBrdf(scene_, hit.point, options_), path.at.normal, -direction);
        return true;
    }

    /// Russian roulette [Arvo90].
    bool survives(Path& path) const {
        const float brightest = std::max({path.throughput.x, path.throughput.y, path.throughput.z});
        if (brightest <= 0.0f) return false;
        if (!options_.roulette || path.bounceCount <= kBouncesBeforeRoulette) return true;
        const float survival = std::min(brightest, kHighestSurvival);
        if (path.random.nextUnitFloat() >= survival) return false;
        path.throughput /= survival;
        return true;
    }

    PathOrigin drawCorner(RandomStream& random, const Hit& hit) const {
        const float choice = random.nextUnitFloat();
        const std::size_t corner = choice < hit.point.u                 ? 1
                                   : choice < hit.point.u + hit.point.v ? 2
                                                                        : 0;
        const Mesh& mesh = scene_.meshes[hit.point.mesh];
        const std::size_t vertex =
            vertexOffsets_[hit.point.mesh] + mesh.indices[3 * hit.point.triangle + corner];
        const auto origins = hit.backFace ? options_.vertexBacks : options_.vertexFronts;
        PRT_ASSERT(vertex < origins.size(), "every vertex met has an origin on the side met");
        return origins[vertex];
    }

    const Scene& scene_;
    const RayScene& rays_;
    const WalkOptions& options_;
    std::vector<std::size_t> vertexOffsets_;  // empty: paths go on from where they are
};

}  // namespace

PathOrigin placePathOrigin(const Scene& scene, const RayScene& rays, const Hit& hit) {
    const Mesh& mesh = scene.meshes[hit.point.mesh];
    const std::uint32_t* corners = &mesh.indices[3 * hit.point.triangle];
    const Vec3f a = rays.tracePoint(mesh.positions[corners[0]]);
    const Vec3f b = rays.tracePoint(mesh.positions[corners[1]]);
    const Vec3f c = rays.tracePoint(mesh.positions[corners[2]]);
    const Vec3f point = a + (b - a) * hit.point.u + (c - a) * hit.point.v;

    const float side = hit.backFace ? -1.0f : 1.0f;
    const Vec3f shading =
        interpolateCorners(mesh, hit.point, std::span<const Vec3f>(mesh.normals)) * side;
    const Vec3f geometric = triangleNormal(a, b, c) * side;
    const Vec3f normal = shading.length2() > 0.0f ? shading.normalized() : geometric;
    return {offsetRayOrigin(point, geometric), normal};
}

Brdf findBrdf(const Scene& scene, const SurfacePoint& point, const WalkOptions& options) {
    const bool isGltf = options.surfaceModel == SurfaceModel::gltf;
    if (isGltf && !options.materialBrdfs.empty()) {
        const Brdf& given = options.materialBrdfs[scene.meshes[point.mesh].material];
        if (hasLobes(given)) return given;
    }
    const Vec3f baseColor = evaluateAlbedo(scene, point);
    if (!isGltf) return {.lobes = {LambertLobe{.albedo = Vec3d(baseColor)}}};
    return makeGltfBrdf(baseColor, evaluateMetallicRoughness(scene, point));
}

Scattering evaluateScattering(const Path& path, const Vec3f& direction) {
    if (path.reflection) return evaluateReflection(*path.reflection, path.at.normal, direction);
    const double density = cosineDensity(path.at.normal, direction);
    if (density <= 0.0) return {};
    return {Vec3d(density), density};
}

void walkPaths(const Scene& scene, const RayScene& rays, const WalkOptions& options,
               std::vector<Path> paths, PathVisitor& visitor) {
    PRT_ASSERT(options.roulette || options.bounceCount >= 0, "every path comes to an end");
    const Walk walk(scene, rays, options);
    while (!paths.empty()) {
        visitor.arrive(paths);
        walk.step(paths, visitor);
    }
}

}  // namespace prt
