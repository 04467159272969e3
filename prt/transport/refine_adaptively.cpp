// Bibliography
//   [Krivanek04]  Adaptive mesh subdivision for precomputed radiance transfer
//   [Rivara84]    Refining the longest edge with each that is refined keeps angles from shrinking
#include "prt/transport/refine_adaptively.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "prt/base/error.h"
#include "prt/basis/sh.h"
#include "prt/parallel/parallel_for.h"
#include "prt/scene/refine.h"
#include "prt/scene/vertex_grouping.h"
#include "prt/transport/gather.h"
#include "prt/transport/interpolation_error.h"

namespace prt {
namespace {

constexpr std::size_t kReceiversPerTask = 128;

using EdgeSet = std::unordered_set<VertexKey, VertexKeyHash>;

/// The bits of both ends, in whichever order they are given.
VertexKey edgeKey(const Vec3f& a, const Vec3f& b) {
    VertexKey forth{};
    putVector(forth, 0, a);
    putVector(forth, 3, b);
    VertexKey back{};
    putVector(back, 0, b);
    putVector(back, 3, a);
    return std::min(forth, back);
}

VertexKey pointKey(const Vec3f& position, const Vec3f& normal) {
    VertexKey key{};
    putVector(key, 0, position);
    putVector(key, 3, normal);
    return key;
}

/// Shadowed transfer at the points of a surface, each computed when first asked for.
class TransferCache {
  public:
    TransferCache(const Scene& scene, const AdaptiveRefineOptions& options)
        : options_(options),
          rays_(scene, {options.isa, options.threadCount}),
          kernels_(selectGatherKernels(options.isa.value_or(detectIsa()))),
          pattern_(padToLanes(static_cast<std::size_t>(options.sampleCount))),
          coefficientCount_(static_cast<std::size_t>(shCoefficientCount(options.bandCount))) {}

    /// Computes the transfer of all vertices that are new.
    ///
    /// @param scene  the same surface as that of the constructor, cut otherwise
    void addVertices(const Scene& scene, int pass) {
        const Receivers receivers = placeReceivers(scene, rays_);
        const std::size_t known = places_.size();
        std::vector<std::uint32_t> newReceivers;
        std::size_t vertex = 0;
        for (const Mesh& mesh : scene.meshes)
            for (std::size_t i = 0; i < mesh.vertexCount(); ++i, ++vertex) {
                const VertexKey key = pointKey(mesh.positions[i], mesh.normals[i]);
                if (places_.try_emplace(key, places_.size()).second)
                    newReceivers.push_back(receivers.frontOfVertex[vertex]);
            }
        transfer_.resize(places_.size() * coefficientCount_);

        const GatherScene gatherScene{scene, rays_, receivers};
        const GatherOptions gatherOptions{options_.bandCount, pattern_.reversedX.size(),
                                          options_.seed, false};
        const std::string stage = "refine " + std::to_string(pass);
        ProgressReporter reporter(options_.progress, stage, "points", newReceivers.size());
        parallelFor(newReceivers.size(), {options_.threadCount, kReceiversPerTask},
                    [&](std::size_t begin, std::size_t end) {
                        Gatherer gatherer(gatherScene, kernels_, pattern_, gatherOptions);
                        HitSlab noHits;
                        for (std::size_t i = begin; i < end; ++i)
                            gatherer.gather(newReceivers[i], transferAt(known + i), noHits);
                        reporter.advance(end - begin);
                    });
    }

    /// How far the transfer in the middle of an edge is from the mean of its ends': ‖T(m) − ½ (T(a)
    /// + T(b))‖.
    double interpolationError(const Mesh& mesh, const SplitEdge& edge) {
        const std::span<const float> a = transferOf(mesh, edge.a);
        const std::span<const float> b = transferOf(mesh, edge.b);
        const std::span<const float> middle = transferOf(mesh, edge.middle);
        double sum = 0.0;
        for (std::size_t i = 0; i < coefficientCount_; ++i) {
            const double difference = middle[i] - 0.5 * (double(a[i]) + double(b[i]));
            sum += difference * difference;
        }
        return std::sqrt(sum);
    }

  private:
    std::span<float> transferAt(std::size_t place) {
        return std::span(transfer_).subspan(place * coefficientCount_, coefficientCount_);
    }

    std::span<const float> transferOf(const Mesh& mesh, std::uint32_t vertex) {
        return transferAt(places_.at(pointKey(mesh.positions[vertex], mesh.normals[vertex])));
    }

    const AdaptiveRefineOptions& options_;
    RayScene rays_;
    GatherKernels kernels_;
    SamplePattern pattern_;
    std::size_t coefficientCount_;
    std::unordered_map<VertexKey, std::size_t, VertexKeyHash> places_;
    std::vector<float> transfer_;
};

/// An edge whose middle is interpolated badly.
struct BadEdge {
    VertexKey key;
    double error;
};

/// Picks, with every edge picked, the longest edges of its triangles, and so on.
void pickLongestEdges(const std::vector<Mesh>& meshes, EdgeSet& picked) {
    for (bool changed = true; changed;) {
        changed = false;
        for (const Mesh& mesh : meshes)
            for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
                VertexKey longest{};
                float longestLength = -1.0f;
                bool anyPicked = false;
                for (std::size_t k = 0; k < 3; ++k) {
                    const Vec3f& a = mesh.positions[mesh.indices[i + k]];
                    const Vec3f& b = mesh.positions[mesh.indices[i + (k + 1) % 3]];
                    const VertexKey key = edgeKey(a, b);
                    anyPicked = anyPicked || picked.contains(key);
                    const float length = (a - b).length();
                    if (length > longestLength) {
                        longestLength = length;
                        longest = key;
                    }
                }
                if (anyPicked && picked.insert(longest).second) changed = true;
            }
    }
}

class AdaptiveRefiner {
  public:
    AdaptiveRefiner(const Scene& scene, const AdaptiveRefineOptions& options,
                    AdaptiveRefineStats& stats)
        : options_(options),
          minEdgeLength_(options.minEdgeLength > 0.0f ? options.minEdgeLength
                                                      : defaultMinEdgeLength(scene)),
          maxDifference_(options.maxError * openTransferNorm(options.bandCount)),
          transfer_(scene, options),
          stats_(stats) {
        shape_.meshes = scene.meshes;
        shape_.materials = scene.materials;
    }

    std::vector<Mesh> run() {
        while (refineOnce()) {
        }
        return std::move(shape_.meshes);
    }

  private:
    bool refineOnce() {
        const std::vector<BadEdge> bad = testNewEdges();
        ++stats_.passCount;
        return !bad.empty() && halve(bad);
    }

    /// @return  the worst first
    std::vector<BadEdge> testNewEdges() {
        Scene halved = shape_;
        const std::vector<SplitEdge> edges = splitEdges(halved.meshes, [&](const Vec3f& a,
                                                                           const Vec3f& b) {
            return (a - b).length() >= 2.0f * minEdgeLength_ && !tested_.contains(edgeKey(a, b));
        });
        if (edges.empty()) return {};
        transfer_.addVertices(halved, stats_.passCount + 1);

        // Triangles of several meshes may share an edge: the worst of them decides.
        std::unordered_map<VertexKey, double, VertexKeyHash> errors;
        for (const SplitEdge& edge : edges) {
            const Mesh& mesh = halved.meshes[edge.mesh];
            const VertexKey key = edgeKey(mesh.positions[edge.a], mesh.positions[edge.b]);
            double& error = errors[key];
            error = std::max(error, transfer_.interpolationError(mesh, edge));
            tested_.insert(key);
        }
        stats_.testedEdgeCount += errors.size();

        std::vector<BadEdge> bad;
        for (const auto& [key, error] : errors)
            if (error > maxDifference_) bad.push_back({key, error});
        std::sort(bad.begin(), bad.end(), [](const BadEdge& a, const BadEdge& b) {
            return std::pair(-a.error, a.key) < std::pair(-b.error, b.key);
        });
        return bad;
    }

    /// Halves the edges, or as many of the worst as there is room for.
    ///
    /// @return  whether there may be room for more
    bool halve(std::vector<BadEdge> bad) {
        for (; !bad.empty(); bad.resize(bad.size() / 2), stats_.ranOutOfVertices = true) {
            EdgeSet picked;
            for (const BadEdge& edge : bad)
                picked.insert(edge.key);
            pickLongestEdges(shape_.meshes, picked);
            Scene refined = shape_;
            splitEdges(refined.meshes, [&](const Vec3f& a, const Vec3f& b) {
                return picked.contains(edgeKey(a, b));
            });
            if (refined.vertexCount() > options_.maxVertexCount) continue;
            shape_ = std::move(refined);
            break;
        }
        return !stats_.ranOutOfVertices;
    }

    const AdaptiveRefineOptions& options_;
    float minEdgeLength_;
    double maxDifference_;
    TransferCache transfer_;
    AdaptiveRefineStats& stats_;
    Scene shape_;  // meshes and materials alone
    EdgeSet tested_;
};

}  // namespace

float defaultMinEdgeLength(const Scene& scene) {
    constexpr float kEdgesPerRadius = 256.0f;
    return scene.vertexCount() > 0 ? computeBounds(scene).radius() / kEdgesPerRadius : 0.0f;
}

Scene refineAdaptively(const Scene& scene, const AdaptiveRefineOptions& options,
                       AdaptiveRefineStats* stats) {
    checkGatherRanges(options.bandCount, options.sampleCount);
    if (!(options.maxError > 0.0f))
        throw Error(ErrorCode::invalidOption, "the error to refine to must be positive");
    if (!(options.minEdgeLength >= 0.0f))
        throw Error(ErrorCode::invalidOption,
                    "the shortest edge must have a positive length or be 0");
    AdaptiveRefineStats ownStats;
    AdaptiveRefineStats& report = stats ? *stats : ownStats;
    report = {};
    Scene refined = scene;
    if (scene.triangleCount() > 0) refined.meshes = AdaptiveRefiner(scene, options, report).run();
    return refined;
}

}  // namespace prt
