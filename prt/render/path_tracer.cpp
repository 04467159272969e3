// Bibliography
//   [Veach95]  Optimally combining sampling techniques for Monte Carlo rendering
#include "prt/render/path_tracer.h"

#include <algorithm>
#include <string>
#include <utility>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/parallel/parallel_for.h"
#include "prt/scene/normals.h"

namespace prt {
namespace {

/// Paths that walk together: enough to fill the ray tracer's packets, few enough for a cache.
constexpr std::size_t kBatchPaths = 4096;
/// Keeps the paths' random streams apart from those of the rays from the eye.
constexpr std::uint64_t kPathSeedSalt = 0x70617468u;

constexpr int kMaxSampleCount = 1 << 24;

void checkOptions(const PathTracerOptions& options, int sampleCount) {
    if (sampleCount < 2 || sampleCount > kMaxSampleCount)
        throw Error(ErrorCode::invalidOption, "the number of paths must lie between 2 and " +
                                                  std::to_string(kMaxSampleCount));
    const WalkOptions& walk = options.walk;
    if (walk.bounceCount < 0 && walk.bounceCount != kUnlimitedBounces)
        throw Error(ErrorCode::invalidOption, "the number of bounces must not be negative");
    if (walk.bounceCount == kUnlimitedBounces && !walk.roulette)
        throw Error(ErrorCode::invalidOption, "bounces without a limit need roulette to end");
}

/// Sums of values and of their squares.
struct Moments {
    Vec3d sum{0.0, 0.0, 0.0};
    Vec3d squareSum{0.0, 0.0, 0.0};

    void add(const Vec3d& value) {
        sum += value;
        squareSum += value * value;
    }
};

double varianceOfMean(double sum, double squareSum, int sampleCount) {
    const auto n = static_cast<double>(sampleCount);
    return std::max(squareSum - sum * sum / n, 0.0) / (n * (n - 1.0));
}

Vec3d varianceOfMean(const Moments& moments, int sampleCount) {
    Vec3d variance;
    for (int channel = 0; channel < 3; ++channel)
        variance[channel] =
            varianceOfMean(moments.sum[channel], moments.squareSum[channel], sampleCount);
    return variance;
}

/// The light that each path of a batch brings home.
class RadianceVisitor final : public PathVisitor {
  public:
    RadianceVisitor(const RayScene& rays, const DistantLight& light, bool lightSampling,
                    std::size_t pathCount)
        : rays_(rays),
          light_(light),
          lightSampling_(lightSampling),
          radiance_(pathCount, Vec3d(0.0)) {}

    /// Adds the light that a direction drawn towards it brings, where nothing stands between.
    void arrive(std::span<Path> paths) override {
        if (!lightSampling_) return;
        std::vector<std::size_t> indices;
        std::vector<Vec3f> contributions;
        std::vector<std::pair<Vec3f, Vec3f>> ends;
        for (Path& path : paths) {
            const LightSample sample = light_.sample(path.random);
            const Scattering scattering = evaluateScattering(path, sample.direction);
            if (scattering.value == Vec3d(0.0) || sample.density <= 0.0) continue;
            const double balance = 1.0 / (1.0 + scattering.density / sample.density);
            indices.push_back(path.index);
            contributions.push_back(path.throughput * sample.radianceOverDensity *
                                    Vec3f(scattering.value * balance));
            ends.emplace_back(path.at.position, sample.direction);
        }
        RayStream stream(ends.size());
        for (std::size_t i = 0; i < ends.size(); ++i)
            stream.setRay(i, ends[i].first, ends[i].second);
        rays_.findOccluded(stream);
        for (std::size_t i = 0; i < ends.size(); ++i)
            if (!(stream.tFar[i] < 0.0f)) radiance_[indices[i]] += Vec3d(contributions[i]);
    }

    void escape(const Path& path, const Vec3f& direction) override {
        if (path.density <= 0.0) return;
        const LightValue value = light_.evaluate(direction);
        const double balance = lightSampling_ ? 1.0 / (1.0 + value.density / path.density) : 1.0;
        radiance_[path.index] += Vec3d(path.throughput * value.radiance) * balance;
    }

    std::span<const Vec3d> radiance() const { return radiance_; }

  private:
    const RayScene& rays_;
    const DistantLight& light_;
    bool lightSampling_;
    std::vector<Vec3d> radiance_;
};

/// Sums y_i over the paths that escape, for each origin.
class TransferVisitor final : public PathVisitor {
  public:
    /// @param sums, squareSums  of the origins, [origin][channel][coefficient]
    TransferVisitor(int bandCount, std::size_t firstPath, std::size_t sampleCount,
                    std::span<double> sums, std::span<double> squareSums)
        : bandCount_(bandCount),
          firstPath_(firstPath),
          sampleCount_(sampleCount),
          sums_(sums),
          squareSums_(squareSums),
          values_(static_cast<std::size_t>(shCoefficientCount(bandCount))) {}

    void arrive(std::span<Path>) override {}

    void escape(const Path& path, const Vec3f& direction) override {
        evaluateSh(Vec3d(direction), bandCount_, values_);
        std::size_t place = (firstPath_ + path.index) / sampleCount_ * 3 * values_.size();
        for (int channel = 0; channel < 3; ++channel) {
            for (const double value : values_) {
                const double coefficient = static_cast<double>(path.throughput[channel]) * value;
                sums_[place] += coefficient;
                squareSums_[place++] += coefficient * coefficient;
            }
        }
    }

  private:
    int bandCount_;
    std::size_t firstPath_;
    std::size_t sampleCount_;
    std::span<double> sums_;
    std::span<double> squareSums_;
    std::vector<double> values_;
};

void startAt(const PathOrigin& origin, Path& path) {
    path.at = origin;
}
void startAt(const ExitPoint& point, Path& path) {
    path.at = point.origin;
    path.reflection = point.reflection;
}

/// Paths from some of many points.
template <class Point>
struct PathSource {
    std::span<const Point> points;
    std::uint64_t firstStream = 0;
    std::size_t sampleCount = 0;  // paths a point
    std::uint64_t seed = 1;

    std::size_t pathCount() const { return points.size() * sampleCount; }

    /// Paths [begin, end), numbered point after point.
    std::vector<Path> makePaths(std::size_t begin, std::size_t end) const {
        std::vector<Path> paths(end - begin);
        for (std::size_t i = begin; i < end; ++i) {
            Path& path = paths[i - begin];
            path.index = i - begin;
            path.random = RandomStream(seed ^ kPathSeedSalt, firstStream * sampleCount + i);
            startAt(points[i / sampleCount], path);
        }
        return paths;
    }
};

/// Calls `walk(begin, end)` for consecutive batches of paths.
template <class Walk>
void forBatches(std::size_t pathCount, const Walk& walk) {
    for (std::size_t begin = 0; begin < pathCount; begin += kBatchPaths)
        walk(begin, std::min(begin + kBatchPaths, pathCount));
}

template <class Point>
std::vector<Moments> sumRadiance(const Scene& scene, const RayScene& rays,
                                 const DistantLight& light, const PathSource<Point>& source,
                                 const PathTracerOptions& options) {
    std::vector<Moments> moments(source.points.size());
    forBatches(source.pathCount(), [&](std::size_t begin, std::size_t end) {
        RadianceVisitor visitor(rays, light, options.lightSampling, end - begin);
        walkPaths(scene, rays, options.walk, source.makePaths(begin, end), visitor);
        for (std::size_t i = begin; i < end; ++i)
            moments[i / source.sampleCount].add(visitor.radiance()[i - begin]);
    });
    return moments;
}

/// Origins a task, so that a task fills a batch.
std::size_t originsPerChunk(std::size_t sampleCount) {
    return std::max<std::size_t>(kBatchPaths / sampleCount, 1);
}

template <class Point>
RadianceEstimate estimateMeans(const Scene& scene, const RayScene& rays, const DistantLight& light,
                               std::span<const Point> points, int sampleCount,
                               const PathTracerOptions& options) {
    checkOptions(options, sampleCount);
    const auto pathsPerPoint = static_cast<std::size_t>(sampleCount);
    RadianceEstimate estimate{std::vector<Vec3d>(points.size()), std::vector<Vec3d>(points.size())};
    ProgressReporter progress(options.progress, "estimate", "points", points.size());
    parallelFor(points.size(), {options.threadCount, originsPerChunk(pathsPerPoint)},
                [&](std::size_t begin, std::size_t end) {
                    const PathSource<Point> source{points.subspan(begin, end - begin),
                                                   options.firstStream + begin, pathsPerPoint,
                                                   options.seed};
                    const std::vector<Moments> moments =
                        sumRadiance(scene, rays, light, source, options);
                    for (std::size_t i = begin; i < end; ++i) {
                        const Moments& sums = moments[i - begin];
                        estimate.mean[i] = sums.sum / static_cast<double>(sampleCount);
                        estimate.variance[i] = varianceOfMean(sums, sampleCount);
                    }
                    progress.advance(end - begin);
                });
    return estimate;
}

}  // namespace

RadianceEstimate estimateRadiance(const Scene& scene, const RayScene& rays,
                                  const DistantLight& light, std::span<const PathOrigin> origins,
                                  int sampleCount, const PathTracerOptions& options) {
    return estimateMeans(scene, rays, light, origins, sampleCount, options);
}

RadianceEstimate estimateExitRadiance(const Scene& scene, const RayScene& rays,
                                      const DistantLight& light, std::span<const ExitPoint> points,
                                      int sampleCount, const PathTracerOptions& options) {
    return estimateMeans(scene, rays, light, points, sampleCount, options);
}

TransferEstimate estimateTransfer(const Scene& scene, const RayScene& rays, int bandCount,
                                  std::span<const PathOrigin> origins, int sampleCount,
                                  const PathTracerOptions& options) {
    checkOptions(options, sampleCount);
    if (bandCount < 1)
        throw Error(ErrorCode::invalidOption, "the number of bands must be at least 1");
    const auto pathsPerOrigin = static_cast<std::size_t>(sampleCount);
    const std::size_t rowSize = 3 * static_cast<std::size_t>(shCoefficientCount(bandCount));
    TransferEstimate estimate{bandCount, std::vector<double>(origins.size() * rowSize),
                              std::vector<double>(origins.size() * rowSize)};
    ProgressReporter progress(options.progress, "estimate", "points", origins.size());
    parallelFor(
        origins.size(), {options.threadCount, originsPerChunk(pathsPerOrigin)},
        [&](std::size_t begin, std::size_t end) {
            const PathSource<PathOrigin> source{origins.subspan(begin, end - begin),
                                                options.firstStream + begin, pathsPerOrigin,
                                                options.seed};
            const auto sums =
                std::span(estimate.mean).subspan(begin * rowSize, (end - begin) * rowSize);
            const auto squareSums =
                std::span(estimate.variance).subspan(begin * rowSize, (end - begin) * rowSize);
            forBatches(source.pathCount(), [&](std::size_t first, std::size_t last) {
                TransferVisitor visitor(bandCount, first, pathsPerOrigin, sums, squareSums);
                walkPaths(scene, rays, options.walk, source.makePaths(first, last), visitor);
            });
            progress.advance(end - begin);
        });
    for (std::size_t i = 0; i < estimate.mean.size(); ++i) {
        estimate.variance[i] = varianceOfMean(estimate.mean[i], estimate.variance[i], sampleCount);
        estimate.mean[i] /= static_cast<double>(sampleCount);
    }
    return estimate;
}

std::vector<PathOrigin> placeVertexOrigins(const Scene& scene, const RayScene& rays) {
    constexpr float kInset = 1e-3f;
    std::vector<PathOrigin> origins;
    origins.reserve(scene.vertexCount());
    for (std::size_t meshIndex = 0; meshIndex < scene.meshes.size(); ++meshIndex) {
        const Mesh& mesh = scene.meshes[meshIndex];
        const std::size_t firstVertex = origins.size();
        for (std::size_t i = 0; i < mesh.vertexCount(); ++i)
            origins.push_back({rays.tracePoint(mesh.positions[i]), mesh.normals[i]});
        // Of the triangles around a vertex take the one that its normal fits best.
        std::vector<float> bestFit(mesh.vertexCount(), -2.0f);
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
            const std::uint32_t vertex = mesh.indices[i];
            const std::uint32_t* corners = &mesh.indices[i / 3 * 3];
            const float fit = mesh.normals[vertex].dot(triangleNormal(mesh.positions[corners[0]],
                                                                      mesh.positions[corners[1]],
                                                                      mesh.positions[corners[2]]));
            if (fit <= bestFit[vertex]) continue;
            bestFit[vertex] = fit;
            // Weights of the second and the third corner.
            const float u = i % 3 == 1 ? 1.0f - 2.0f * kInset : kInset;
            const float v = i % 3 == 2 ? 1.0f - 2.0f * kInset : kInset;
            const Hit beside{false, 0.0f, {meshIndex, i / 3, u, v}, false};
            origins[firstVertex + vertex].position = placePathOrigin(scene, rays, beside).position;
        }
    }
    return origins;
}

}  // namespace prt
