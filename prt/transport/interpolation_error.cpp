#include "prt/transport/interpolation_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "prt/base/assert.h"
#include "prt/base/random.h"
#include "prt/basis/sh.h"
#include "prt/basis/zonal.h"
#include "prt/parallel/parallel_for.h"
#include "prt/scene/normals.h"
#include "prt/scene/surface_color.h"
#include "prt/trace/ray_offset.h"
#include "prt/transport/gather.h"

namespace prt {
namespace {

constexpr std::size_t kPointsPerTask = 64;

/// Area of the triangles up to and with each, mesh after mesh.
std::vector<double> accumulateAreas(const Scene& scene) {
    std::vector<double> areas;
    for (const Mesh& mesh : scene.meshes)
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const Vec3d a(mesh.positions[mesh.indices[i]]);
            const Vec3d b(mesh.positions[mesh.indices[i + 1]]);
            const Vec3d c(mesh.positions[mesh.indices[i + 2]]);
            areas.push_back(0.5 * (b - a).cross(c - a).length());
        }
    std::partial_sum(areas.begin(), areas.end(), areas.begin());
    return areas;
}

/// Points of equal shares of the surface.
std::vector<SurfacePoint> spreadPoints(const Scene& scene,
                                       const InterpolationErrorOptions& options) {
    const std::vector<double> areas = accumulateAreas(scene);
    std::vector<SurfacePoint> points(areas.empty() ? 0 : options.pointCount);
    RandomStream random(options.seed, 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double share =
            (static_cast<double>(i) + random.nextUnitDouble()) / static_cast<double>(points.size());
        const auto found = std::upper_bound(areas.begin(), areas.end(), share * areas.back());
        auto triangle = static_cast<std::size_t>(std::min(found, areas.end() - 1) - areas.begin());
        SurfacePoint& point = points[i];
        while (triangle >= scene.meshes[point.mesh].triangleCount())
            triangle -= scene.meshes[point.mesh++].triangleCount();
        point.triangle = triangle;
        const float root = std::sqrt(random.nextUnitFloat());
        point.v = root * random.nextUnitFloat();
        point.u = root - point.v;
    }
    return points;
}

Receivers placeAt(const Scene& scene, const RayScene& rays,
                  const std::vector<SurfacePoint>& points) {
    Receivers receivers;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Mesh& mesh = scene.meshes[points[i].mesh];
        const std::uint32_t* corners = &mesh.indices[3 * points[i].triangle];
        const Vec3f position =
            interpolateCorners(mesh, points[i], std::span<const Vec3f>(mesh.positions));
        const Vec3f normal =
            interpolateCorners(mesh, points[i], std::span<const Vec3f>(mesh.normals)).normalized();
        const Vec3f face = triangleNormal(mesh.positions[corners[0]], mesh.positions[corners[1]],
                                          mesh.positions[corners[2]]);
        const Vec3f up = face.dot(normal) < 0.0f ? -face : face;
        receivers.fronts.push_back({offsetRayOrigin(rays.tracePoint(position), up), normal, i});
    }
    return receivers;
}

/// Linear between the transfer vectors of a triangle's corners.
class TransferInterpolator {
  public:
    TransferInterpolator(const Scene& scene, const TransferField& field)
        : scene_(scene),
          field_(field),
          layer_(*field.findLayer(Transport::shadowed)),
          vertexOffsets_(vertexOffsets(scene)) {}

    double differenceAt(const SurfacePoint& point, std::span<const float> computed) const {
        const auto a = cornerTransfer(point, 0);
        const auto b = cornerTransfer(point, 1);
        const auto c = cornerTransfer(point, 2);
        double sum = 0.0;
        for (std::size_t i = 0; i < computed.size(); ++i) {
            const double difference =
                a[i] + (b[i] - a[i]) * point.u + (c[i] - a[i]) * point.v - computed[i];
            sum += difference * difference;
        }
        return std::sqrt(sum);
    }

  private:
    std::vector<float> cornerTransfer(const SurfacePoint& point, std::size_t corner) const {
        const std::uint32_t vertex = scene_.meshes[point.mesh].indices[3 * point.triangle + corner];
        return transferVector(field_, layer_,
                              field_.receiverOfVertex[vertexOffsets_[point.mesh] + vertex], 0);
    }

    const Scene& scene_;
    const TransferField& field_;
    const TransferLayer& layer_;
    std::vector<std::size_t> vertexOffsets_;
};

}  // namespace

double openTransferNorm(int bandCount) {
    std::vector<float> open(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    unshadowedTransfer({0.0f, 0.0f, 1.0f}, bandCount, open);
    return std::sqrt(std::inner_product(open.begin(), open.end(), open.begin(), 0.0));
}

InterpolationError measureInterpolationError(const Scene& scene, const TransferField& field,
                                             const InterpolationErrorOptions& options) {
    checkGatherRanges(field.bandCount, options.sampleCount);
    PRT_ASSERT(field.findLayer(Transport::shadowed), "there is shadowed transfer to interpolate");
    const RayScene rays(scene, {{}, options.threadCount});
    const std::vector<SurfacePoint> points = spreadPoints(scene, options);
    if (points.empty()) return {};
    const Receivers receivers = placeAt(scene, rays, points);
    const TransferInterpolator interpolator(scene, field);

    const GatherKernels kernels = selectGatherKernels(detectIsa());
    const SamplePattern pattern(padToLanes(static_cast<std::size_t>(options.sampleCount)));
    const GatherScene gatherScene{scene, rays, receivers};
    const GatherOptions gatherOptions{field.bandCount, pattern.reversedX.size(), options.seed,
                                      false};
    std::vector<double> differences(points.size());
    ProgressReporter reporter(options.progress, "measure", "points", points.size());
    parallelFor(points.size(), {options.threadCount, kPointsPerTask},
                [&](std::size_t begin, std::size_t end) {
                    Gatherer gatherer(gatherScene, kernels, pattern, gatherOptions);
                    std::vector<float> computed(
                        static_cast<std::size_t>(shCoefficientCount(field.bandCount)));
                    HitSlab noHits;
                    for (std::size_t i = begin; i < end; ++i) {
                        gatherer.gather(static_cast<std::uint32_t>(i), computed, noHits);
                        differences[i] = interpolator.differenceAt(points[i], computed);
                    }
                    reporter.advance(end - begin);
                });

    const double squares =
        std::inner_product(differences.begin(), differences.end(), differences.begin(), 0.0);
    const double unit = openTransferNorm(field.bandCount);
    const auto rank =
        differences.begin() + static_cast<std::ptrdiff_t>(differences.size() * 99 / 100);
    std::nth_element(differences.begin(), rank, differences.end());
    return {std::sqrt(squares / static_cast<double>(differences.size())) / unit, *rank / unit};
}

}  // namespace prt
