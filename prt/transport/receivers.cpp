#include "prt/transport/receivers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

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
    Vec3f normal{0.0f, 0.0f, 0.0f};  // geometric, unit
    Vec3f toCentroid{0.0f, 0.0f, 0.0f};
    float angle = 0.0f;
};

/// All corners of the scene, listed by an attribute of their vertex.
struct CornerLists {
    std::vector<std::uint32_t> begin;  // of each list, and the end of the last
    std::vector<std::uint32_t> corners;

    std::span<const std::uint32_t> of(std::size_t list) const {
        return std::span(corners).subspan(begin[list], begin[list + 1] - begin[list]);
    }
};

CornerLists listCorners(const std::vector<Corner>& corners, const Welding& welding) {
    CornerLists lists;
    lists.begin.assign(welding.vertexOfGroup.size() + 1, 0);
    for (const Corner& corner : corners)
        ++lists.begin[welding.groupOfVertex[corner.vertex] + 1];
    std::partial_sum(lists.begin.begin(), lists.begin.end(), lists.begin.begin());
    lists.corners.resize(corners.size());
    std::vector<std::uint32_t> next(lists.begin.begin(), lists.begin.end() - 1);
    for (std::uint32_t i = 0; i < corners.size(); ++i)
        lists.corners[next[welding.groupOfVertex[corners[i].vertex]]++] = i;
    return lists;
}

std::vector<Corner> findCorners(const Scene& scene, const RayScene& rays) {
    std::vector<Corner> corners;
    corners.reserve(scene.triangleCount() * 3);
    std::uint32_t firstVertex = 0;
    for (const Mesh& mesh : scene.meshes) {
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            std::array<Vec3f, 3> points;
            for (std::size_t k = 0; k < 3; ++k)
                points[k] = rays.tracePoint(mesh.positions[mesh.indices[i + k]]);
            const Vec3f normal = triangleNormal(points[0], points[1], points[2]);
            if (normal == Vec3f(0.0f)) continue;
            const Vec3f centroid = (points[0] + points[1] + points[2]) / 3.0f;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3f to1 = (points[(k + 1) % 3] - points[k]).normalized();
                const Vec3f to2 = (points[(k + 2) % 3] - points[k]).normalized();
                corners.push_back({firstVertex + mesh.indices[i + k], normal, centroid - points[k],
                                   std::acos(std::clamp(to1.dot(to2), -1.0f, 1.0f))});
            }
        }
        firstVertex += static_cast<std::uint32_t>(mesh.vertexCount());
    }
    return corners;
}

/// What surrounds one receiver.
struct Surroundings {
    const std::vector<Corner>& corners;
    std::span<const std::uint32_t> own;     // corners of the receiver's own surface
    std::span<const std::uint32_t> around;  // corners of all surfaces at its position
    bool doubleSided;
};

/// The geometric normal on the side of the shading normal, or of the winding
/// where the surface is one-sided.
Vec3f geometricNormal(const Surroundings& surroundings, const Vec3f& shadingNormal) {
    Vec3f sum(0.0f);
    for (const std::uint32_t i : surroundings.own)
        sum += surroundings.corners[i].normal * surroundings.corners[i].angle;
    if (sum.length2() < 1e-12f) return shadingNormal;
    const Vec3f normal = sum.normalized();
    return surroundings.doubleSided && normal.dot(shadingNormal) < 0.0f ? -normal : normal;
}

/// The direction away from every surface that meets here.
Vec3f freeDirection(const Surroundings& surroundings, const Vec3f& normal) {
    if (surroundings.around.size() == surroundings.own.size()) return normal;
    Vec3f sum(0.0f);
    for (const std::uint32_t i : surroundings.around) {
        const Corner& corner = surroundings.corners[i];
        if (corner.normal.dot(normal) > kOppositeCosine) sum += corner.normal * corner.angle;
    }
    const float length = sum.length();
    return length > 0.0f && sum.dot(normal) > 0.1f * length ? sum / length : normal;
}

/// Where the receiver lies at a rim, a small step from the rim along one of its triangles.
Vec3f rimInset(const Surroundings& surroundings) {
    Vec3f sum(0.0f);
    float angleSum = 0.0f;
    for (const std::uint32_t i : surroundings.own) {
        const Corner& corner = surroundings.corners[i];
        sum += corner.toCentroid.normalized() * corner.angle;
        angleSum += corner.angle;
    }
    if (sum.length() <= kRimThreshold * angleSum) return Vec3f(0.0f);

    const auto alongSum = [&](std::uint32_t i) {
        return surroundings.corners[i].toCentroid.normalized().dot(sum);
    };
    const std::uint32_t inner = *std::max_element(
        surroundings.own.begin(), surroundings.own.end(),
        [&](std::uint32_t a, std::uint32_t b) { return alongSum(a) < alongSum(b); });
    const Vec3f toCentroid = surroundings.corners[inner].toCentroid;
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

/// Position, normal and sidedness of every vertex of the scene.
struct VertexTable {
    std::vector<Vec3f> points;  // tracer's space
    std::vector<Vec3f> normals;
    std::vector<bool> doubleSided;
    bool anyDoubleSided = false;

    VertexTable(const Scene& scene, const RayScene& rays) {
        for (const Mesh& mesh : scene.meshes) {
            for (const Vec3f& position : mesh.positions)
                points.push_back(rays.tracePoint(position));
            normals.insert(normals.end(), mesh.normals.begin(), mesh.normals.end());
            const bool meshDoubleSided = scene.materials[mesh.material].doubleSided;
            doubleSided.insert(doubleSided.end(), mesh.vertexCount(), meshDoubleSided);
            anyDoubleSided |= meshDoubleSided;
        }
    }
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
    const std::vector<Corner> corners = findCorners(scene, rays);
    const CornerLists ownCorners = listCorners(corners, receiverGroups);
    const CornerLists positionCorners = listCorners(corners, positionGroups);

    // Number the groups along the curve.
    const std::size_t groupCount = receiverGroups.vertexOfGroup.size();
    std::vector<Vec3f> groupPoints(groupCount);
    for (std::size_t group = 0; group < groupCount; ++group)
        groupPoints[group] = vertices.points[receiverGroups.vertexOfGroup[group]];
    const std::vector<std::uint32_t> groupOfReceiver = orderAlongCurve(groupPoints);
    std::vector<std::uint32_t> receiverOfGroup(groupCount);
    for (std::uint32_t i = 0; i < groupCount; ++i)
        receiverOfGroup[groupOfReceiver[i]] = i;

    Receivers receivers;
    receivers.fronts.resize(groupCount);
    if (vertices.anyDoubleSided) receivers.backs.resize(groupCount);
    for (std::size_t i = 0; i < groupCount; ++i) {
        const std::size_t group = groupOfReceiver[i];
        const std::size_t vertex = receiverGroups.vertexOfGroup[group];
        const Surroundings surroundings{corners, ownCorners.of(group),
                                        positionCorners.of(positionGroups.groupOfVertex[vertex]),
                                        vertices.doubleSided[vertex]};
        const Vec3f& point = vertices.points[vertex];
        const Vec3f& normal = vertices.normals[vertex];
        receivers.fronts[i] = {placeOrigin(surroundings, point, normal), normal, vertex};
        if (surroundings.doubleSided)
            receivers.backs[i] = {placeOrigin(surroundings, point, -normal), -normal,
                                  vertices.points.size() + vertex};
    }
    receivers.frontOfVertex.resize(receiverGroups.groupOfVertex.size());
    for (std::size_t vertex = 0; vertex < receivers.frontOfVertex.size(); ++vertex)
        receivers.frontOfVertex[vertex] = receiverOfGroup[receiverGroups.groupOfVertex[vertex]];
    receivers.frontsOfTriangle = listTriangleFronts(scene, receivers.frontOfVertex);
    return receivers;
}

}  // namespace prt
