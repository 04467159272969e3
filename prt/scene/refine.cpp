#include "prt/scene/refine.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "prt/base/error.h"

namespace prt {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr std::uint32_t kNotSplit = 0xffffffffu;

// Every decision and every new position depends on the two ends alone and not on their order, so
// that all triangles on an edge, in whatever mesh, cut it in the same place to the last bit.
Vec3f midpointOf(const Vec3f& a, const Vec3f& b) {
    return a * 0.5f + b * 0.5f;
}

// Where floats are too coarse to halve an edge, its middle falls on or near an end.
bool canBeHalved(const Vec3f& a, const Vec3f& b) {
    constexpr float kLargestPart = 0.75f;
    const Vec3f middle = midpointOf(a, b);
    return std::max((middle - a).length(), (middle - b).length()) < kLargestPart * (a - b).length();
}

Vec3f midNormal(const Vec3f& a, const Vec3f& b) {
    const Vec3f sum = a + b;
    return sum.length() > 0.0f ? sum.normalized() : a;
}

// Cuts the triangles of one mesh.
class EdgeSplitter {
  public:
    EdgeSplitter(std::vector<Mesh>& meshes, std::size_t meshIndex, const EdgePredicate& isPicked,
                 std::size_t maxNewVertexCount, std::vector<SplitEdge>& splitEdges)
        : meshIndex_(meshIndex),
          mesh_(meshes[meshIndex]),
          isPicked_(isPicked),
          maxNewVertexCount_(maxNewVertexCount),
          splitEdges_(splitEdges) {}

    void split() {
        std::vector<std::uint32_t> indices = std::move(mesh_.indices);
        mesh_.indices.clear();
        mesh_.indices.reserve(indices.size());
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            splitTriangle({indices[i], indices[i + 1], indices[i + 2]});
        }
    }

  private:
    void splitTriangle(const Triangle& triangle) {
        Triangle middles;
        int splitCount = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            middles[i] = middleOfEdge(triangle[i], triangle[(i + 1) % 3]);
            splitCount += middles[i] != kNotSplit ? 1 : 0;
        }

        // Turn the triangle so that the one edge that differs from the others comes first.
        const bool oddOneIsSplit = splitCount == 1;
        std::size_t first = 0;
        while (first < 2 && (middles[first] != kNotSplit) != oddOneIsSplit)
            ++first;
        const auto [a, b, c] =
            Triangle{triangle[first], triangle[(first + 1) % 3], triangle[(first + 2) % 3]};
        const auto [ab, bc, ca] =
            Triangle{middles[first], middles[(first + 1) % 3], middles[(first + 2) % 3]};

        switch (splitCount) {
            case 0:
                emit(a, b, c);
                break;
            case 1:
                emit(a, ab, c);
                emit(ab, b, c);
                break;
            case 2:
                emit(bc, c, ca);
                emitQuad(a, b, bc, ca);
                break;
            default:
                emit(a, ab, ca);
                emit(ab, b, bc);
                emit(ca, bc, c);
                emit(ab, bc, ca);
        }
    }

    // Cuts along the shorter diagonal, which keeps the triangles fat.
    void emitQuad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        const std::vector<Vec3f>& p = mesh_.positions;
        if ((p[a] - p[c]).length() <= (p[b] - p[d]).length()) {
            emit(a, b, c);
            emit(a, c, d);
        } else {
            emit(a, b, d);
            emit(b, c, d);
        }
    }

    void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
    }

    // The vertex in the middle of an edge, made when first asked for, or kNotSplit.
    std::uint32_t middleOfEdge(std::uint32_t a, std::uint32_t b) {
        const Vec3f& positionA = mesh_.positions[a];
        const Vec3f& positionB = mesh_.positions[b];
        if (!isPicked_(positionA, positionB) || !canBeHalved(positionA, positionB))
            return kNotSplit;
        const std::uint64_t edge = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
        const auto [entry, isNew] =
            middles_.try_emplace(edge, static_cast<std::uint32_t>(mesh_.vertexCount()));
        if (isNew) {
            addMiddle(std::min(a, b), std::max(a, b));
            splitEdges_.push_back({meshIndex_, std::min(a, b), std::max(a, b), entry->second});
        }
        return entry->second;
    }

    void addMiddle(std::uint32_t a, std::uint32_t b) {
        if (middles_.size() > maxNewVertexCount_ || mesh_.vertexCount() >= kNotSplit) {
            throw Error(ErrorCode::limitExceeded, "refining the scene makes too many vertices", {},
                        "allow longer edges (--max-edge) or more vertices (--max-vertices)");
        }
        mesh_.positions.push_back(midpointOf(mesh_.positions[a], mesh_.positions[b]));
        if (!mesh_.normals.empty())
            mesh_.normals.push_back(midNormal(mesh_.normals[a], mesh_.normals[b]));
        for (std::vector<Vec2f>& uvs : mesh_.uvSets) {
            if (!uvs.empty()) uvs.push_back(uvs[a] * 0.5f + uvs[b] * 0.5f);
        }
        if (!mesh_.colors.empty())
            mesh_.colors.push_back(mesh_.colors[a] * 0.5f + mesh_.colors[b] * 0.5f);
    }

    std::size_t meshIndex_;
    Mesh& mesh_;
    const EdgePredicate& isPicked_;
    std::size_t maxNewVertexCount_;
    std::vector<SplitEdge>& splitEdges_;
    std::unordered_map<std::uint64_t, std::uint32_t> middles_;
};

}  // namespace

float defaultMaxEdgeLength(const Scene& scene) {
    constexpr float kEdgesPerRadius = 16.0f;
    return scene.vertexCount() > 0 ? computeBounds(scene).radius() / kEdgesPerRadius : 0.0f;
}

Scene refineEdges(const Scene& scene, const RefineOptions& options) {
    if (!(options.maxEdgeLength >= 0.0f)) {
        throw Error(ErrorCode::invalidOption,
                    "the longest edge must have a positive length or be 0");
    }
    const float maxEdgeLength =
        options.maxEdgeLength > 0.0f ? options.maxEdgeLength : defaultMaxEdgeLength(scene);
    const auto isTooLong = [&](const Vec3f& a, const Vec3f& b) {
        return (a - b).length() > maxEdgeLength;
    };
    Scene refined = scene;
    while (!splitEdges(refined.meshes, isTooLong, options.maxVertexCount).empty()) {
    }
    return refined;
}

std::vector<SplitEdge> splitEdges(std::vector<Mesh>& meshes, const EdgePredicate& isPicked,
                                  std::size_t maxVertexCount) {
    std::size_t vertexCount = 0;
    for (const Mesh& mesh : meshes)
        vertexCount += mesh.vertexCount();
    std::vector<SplitEdge> edges;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const std::size_t made = vertexCount + edges.size();
        const std::size_t allowed = maxVertexCount - std::min(maxVertexCount, made);
        EdgeSplitter(meshes, i, isPicked, allowed, edges).split();
    }
    return edges;
}

}  // namespace prt
