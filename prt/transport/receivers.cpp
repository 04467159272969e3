#include "prt/transport/receivers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "prt/base/error.h"
#include "prt/scene/normals.h"
#include "prt/scene/weld.h"
#include "prt/trace/ray_offset.h"

namespace prt {
namespace {

// Surfaces further apart than this at a vertex are the two sides of a thin
// sheet, not the walls of a corner.
constexpr float kOppositeCosine = -0.5f;
// The mean direction to the surrounding triangles is near 0 inside a
// surface and near 1 at a sharp rim.
constexpr float kRimThreshold = 0.4f;
constexpr float kRimInset = 1e-3f;
// Rim insets stay above the rounding of coordinates near 1, and inside their triangle.
constexpr float kSmallestInset = 0x1p-16f;
constexpr float kLargestInsetFraction = 0.25f;

/// A triangle as seen from one of its corners.
struct Corner {
    std::uint32_t vertex = 0;        // scene-wide
    Vec3f normal{0.0f, 0.0f, 0.0f};  // geometric, unit; 0 where the triangle has no area
    Vec3f toCentroid{0.0f, 0.0f, 0.0f};
    float angle = 0.0f;
};

/// The corners of all triangles, three a triangle, mesh after mesh. They are many: only which of
/// them meet at a position is kept, what they look like is computed when asked for.
class CornerTable {
  public:
    CornerTable(const Scene& scene, const RayScene& rays, const Welding& positionGroups)
        : scene_(scene), rays_(rays) {
        if (scene.triangleCount() > std::numeric_limits<std::uint32_t>::max() / 3)
            throw Error(ErrorCode::limitExceeded, "the scene has more than 1431655765 triangles");
        std::uint32_t vertexCount = 0;
        std::uint32_t cornerCount = 0;
        for (const Mesh& mesh : scene.meshes) {
            firstVertex_.push_back(vertexCount);
            firstCorner_.push_back(cornerCount);
            vertexCount += static_cast<std::uint32_t>(mesh.vertexCount());
            cornerCount += static_cast<std::uint32_t>(mesh.indices.size());
        }
        listByPosition(positionGroups, cornerCount);
    }

    /// Replaces `corners` by those that meet at a position and have an area.
    void findAround(std::uint32_t positionGroup, std::vector<Corner>& corners) const {
        corners.clear();
        for (std::uint32_t i = begin_[positionGroup]; i < begin_[positionGroup + 1]; ++i) {
            const Corner corner = makeCorner(corners_[i]);
            if (corner.normal != Vec3f(0.0f)) corners.push_back(corner);
        }
        // Sums over corners must not depend on the order of the scene's triangles.
        const auto keyOf = [](const Corner& c) {
            return std::tie(c.toCentroid.x, c.toCentroid.y, c.toCentroid.z, c.normal.x, c.normal.y,
                            c.normal.z);
        };
        std::sort(corners.begin(), corners.end(),
                  [&](const Corner& a, const Corner& b) { return keyOf(a) < keyOf(b); });
    }

  private:
    void listByPosition(const Welding& positionGroups, std::uint32_t cornerCount) {
        begin_.assign(positionGroups.vertexOfGroup.size() + 1, 0);
        forEachCorner([&](std::uint32_t vertex, std::uint32_t) {
            ++begin_[positionGroups.groupOfVertex[vertex] + 1];
        });
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        corners_.resize(cornerCount);
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        forEachCorner([&](std::uint32_t vertex, std::uint32_t corner) {
            corners_[next[positionGroups.groupOfVertex[vertex]]++] = corner;
        });
    }

    template <class Visitor>
    void forEachCorner(const Visitor& visit) const {
        for (std::size_t mesh = 0; mesh < scene_.meshes.size(); ++mesh) {
            std::uint32_t corner = firstCorner_[mesh];
            for (const std::uint32_t vertex : scene_.meshes[mesh].indices)
                visit(firstVertex_[mesh] + vertex, corner++);
        }
    }

    Corner makeCorner(std::uint32_t corner) const {
        const auto found = std::upper_bound(firstCorner_.begin(), firstCorner_.end(), corner) - 1;
        const auto meshIndex = static_cast<std::size_t>(found - firstCorner_.begin());
        const Mesh& mesh = scene_.meshes[meshIndex];
        const std::uint32_t k = (corner - *found) % 3;
        const std::uint32_t* triangle = &mesh.indices[corner - *found - k];
        std::array<Vec3f, 3> points;
        for (std::size_t i = 0; i < 3; ++i)
            points[i] = rays_.tracePoint(mesh.positions[triangle[i]]);
        const Vec3f centroid = (points[0] + points[1] + points[2]) / 3.0f;
        const Vec3f to1 = (points[(k + 1) % 3] - points[k]).normalized();
        const Vec3f to2 = (points[(k + 2) % 3] - points[k]).normalized();
        return {firstVertex_[meshIndex] + triangle[k],
                triangleNormal(points[0], points[1], points[2]), centroid - points[k],
                std::acos(std::clamp(to1.dot(to2), -1.0f, 1.0f))};
    }

    const Scene& scene_;
    const RayScene& rays_;
    std::vector<std::uint32_t> firstVertex_;  // of each mesh
    std::vector<std::uint32_t> firstCorner_;
    std::vector<std::uint32_t> begin_;  // of each position's list, and the end of the last
    std::vector<std::uint32_t> corners_;
};

/// What surrounds one receiver.
struct Surroundings {
    std::vector<Corner> own;     // corners of the receiver's own surface
    std::vector<Corner> around;  // corners of all surfaces at its position
    bool doubleSided = false;
};

/// The geometric normal on the side of the shading normal, or of the winding
/// where the surface is one-sided.
Vec3f geometricNormal(const Surroundings& surroundings, const Vec3f& shadingNormal) {
    Vec3f sum(0.0f);
    for (const Corner& corner : surroundings.own)
        sum += corner.normal * corner.angle;
    if (sum.length2() < 1e-12f) return shadingNormal;
    const Vec3f normal = sum.normalized();
    return surroundings.doubleSided && normal.dot(shadingNormal) < 0.0f ? -normal : normal;
}

/// The direction away from every surface that meets here.
Vec3f freeDirection(const Surroundings& surroundings, const Vec3f& normal) {
    if (surroundings.around.size() == surroundings.own.size()) return normal;
    Vec3f sum(0.0f);
    for (const Corner& corner : surroundings.around)
        if (corner.normal.dot(normal) > kOppositeCosine) sum += corner.normal * corner.angle;
    const float length = sum.length();
    return length > 0.0f && sum.dot(normal) > 0.1f * length ? sum / length : normal;
}

/// Where the receiver lies at a rim, a small step from the rim along one of its triangles.
Vec3f rimInset(const Surroundings& surroundings) {
    Vec3f sum(0.0f);
    float angleSum = 0.0f;
    for (const Corner& corner : surroundings.own) {
        sum += corner.toCentroid.normalized() * corner.angle;
        angleSum += corner.angle;
    }
    if (sum.length() <= kRimThreshold * angleSum) return Vec3f(0.0f);

    const auto alongSum = [&](const Corner& corner) {
        return corner.toCentroid.normalized().dot(sum);
    };
    const Vec3f toCentroid = std::max_element(surroundings.own.begin(), surroundings.own.end(),
                                              [&](const Corner& a, const Corner& b) {
                                                  return alongSum(a) < alongSum(b);
                                              })
                                 ->toCentroid;
    const float length = toCentroid.length();
    const float step =
        std::max(kRimInset * length, std::min(kSmallestInset, kLargestInsetFraction * length));
    return toCentroid * (step / length);
}

Vec3f placeOrigin(const Surroundings& surroundings, const Vec3f& point,
                  const Vec3f& shadingNormal) {
    const Vec3f normal = geometricNormal(surroundings, shadingNormal);
    return offsetRayOrigin(point + rimInset(surroundings), freeDirection(surroundings, normal));
}

/// Interleaves the top ten bits of three coordinates in [−1, 1].
std::uint32_t mortonCode(const Vec3f& point) {
    std::uint32_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        auto bits =
            static_cast<std::uint32_t>(std::clamp((point[axis] + 1.0f) * 512.0f, 0.0f, 1023.0f));
        bits = (bits | (bits << 16)) & 0x030000ffu;
        bits = (bits | (bits << 8)) & 0x0300f00fu;
        bits = (bits | (bits << 4)) & 0x030c30c3u;
        bits = (bits | (bits << 2)) & 0x09249249u;
        code |= bits << axis;
    }
    return code;
}

/// Where each group goes on the Morton curve.
std::vector<std::uint32_t> orderAlongCurve(const std::vector<Vec3f>& points) {
    std::vector<std::uint32_t> codes(points.size());
    std::transform(points.begin(), points.end(), codes.begin(), mortonCode);
    std::vector<std::uint32_t> groups(points.size());
    std::iota(groups.begin(), groups.end(), 0u);
    std::stable_sort(groups.begin(), groups.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return codes[a] < codes[b]; });
    return groups;
}

/// Position, normal and sidedness of vertices by their scene-wide number.
class VertexTable {
  public:
    VertexTable(const Scene& scene, const RayScene& rays)
        : scene_(scene), rays_(rays), offsets_(vertexOffsets(scene)) {}

    Vec3f point(std::size_t vertex) const {  // tracer's space
        const auto [mesh, own] = find(vertex);
        return rays_.tracePoint(mesh.positions[own]);
    }

    Vec3f normal(std::size_t vertex) const {
        const auto [mesh, own] = find(vertex);
        return mesh.normals[own];
    }

    bool isDoubleSided(std::size_t vertex) const {
        return scene_.materials[find(vertex).first.material].doubleSided;
    }

  private:
    std::pair<const Mesh&, std::size_t> find(std::size_t vertex) const {
        const auto after = std::upper_bound(offsets_.begin(), offsets_.end() - 1, vertex);
        const auto mesh = static_cast<std::size_t>(after - 1 - offsets_.begin());
        return {scene_.meshes[mesh], vertex - offsets_[mesh]};
    }

    const Scene& scene_;
    const RayScene& rays_;
    std::vector<std::size_t> offsets_;
};

std::vector<std::array<std::uint32_t, 3>> listTriangleFronts(
    const Scene& scene, const std::vector<std::uint32_t>& frontOfVertex) {
    std::vector<std::array<std::uint32_t, 3>> fronts;
    fronts.reserve(scene.triangleCount());
    std::size_t firstVertex = 0;
    for (const Mesh& mesh : scene.meshes) {
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
            fronts.push_back({frontOfVertex[firstVertex + mesh.indices[i]],
                              frontOfVertex[firstVertex + mesh.indices[i + 1]],
                              frontOfVertex[firstVertex + mesh.indices[i + 2]]});
        firstVertex += mesh.vertexCount();
    }
    return fronts;
}

}  // namespace

Receivers placeReceivers(const Scene& scene, const RayScene& rays) {
    const VertexTable vertices(scene, rays);
    const Welding receiverGroups = weldVertices(scene);
    const Welding positionGroups = weldPositions(scene);
    const CornerTable corners(scene, rays, positionGroups);

    // Number the groups along the curve.
    const std::size_t groupCount = receiverGroups.vertexOfGroup.size();
    std::vector<Vec3f> groupPoints(groupCount);
    for (std::size_t group = 0; group < groupCount; ++group)
        groupPoints[group] = vertices.point(receiverGroups.vertexOfGroup[group]);
    const std::vector<std::uint32_t> groupOfReceiver = orderAlongCurve(groupPoints);
    std::vector<std::uint32_t> receiverOfGroup(groupCount);
    for (std::uint32_t i = 0; i < groupCount; ++i)
        receiverOfGroup[groupOfReceiver[i]] = i;

    Receivers receivers;
    receivers.fronts.resize(groupCount);
    const bool anyDoubleSided =
        std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const Mesh& mesh) {
            return mesh.vertexCount() > 0 && scene.materials[mesh.material].doubleSided;
        });
    if (anyDoubleSided) receivers.backs.resize(groupCount);
    Surroundings surroundings;
    for (std::size_t i = 0; i < groupCount; ++i) {
        const std::uint32_t group = groupOfReceiver[i];
        const std::size_t vertex = receiverGroups.vertexOfGroup[group];
        corners.findAround(positionGroups.groupOfVertex[vertex], surroundings.around);
        surroundings.own.clear();
        for (const Corner& corner : surroundings.around)
            if (receiverGroups.groupOfVertex[corner.vertex] == group)
                surroundings.own.push_back(corner);
        surroundings.doubleSided = vertices.isDoubleSided(vertex);
        const Vec3f point = vertices.point(vertex);
        const Vec3f normal = vertices.normal(vertex);
        receivers.fronts[i] = {placeOrigin(surroundings, point, normal), normal, vertex};
        if (surroundings.doubleSided)
            receivers.backs[i] = {placeOrigin(surroundings, point, -normal), -normal,
                                  receiverGroups.groupOfVertex.size() + vertex};
    }
    receivers.frontOfVertex.resize(receiverGroups.groupOfVertex.size());
    for (std::size_t vertex = 0; vertex < receivers.frontOfVertex.size(); ++vertex)
        receivers.frontOfVertex[vertex] = receiverOfGroup[receiverGroups.groupOfVertex[vertex]];
    receivers.frontsOfTriangle = listTriangleFronts(scene, receivers.frontOfVertex);
    return receivers;
}

}  // namespace prt
