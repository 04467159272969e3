#include "prt/scene/normals.h"

#include <cmath>

#include "prt/scene/vertex_grouping.h"

// [Thuermer98] G. Thürmer, C. Wüthrich: Computing vertex normals from polygonal facets, 1998.
// Weighting by the corner angle makes the result independent of how faces are cut into triangles.

namespace prt {
namespace {

Vec3f normalizedOr(const Vec3d& vector, const Vec3f& fallback) {
    const double length = vector.length();
    return length > 0.0 ? Vec3f(vector / length) : fallback;
}

// Adds a triangle's normal to the sums of its corners, each times the angle there.
void addTriangle(const std::array<Vec3d, 3>& corners, const std::array<std::uint32_t, 3>& groups,
                 std::vector<Vec3d>& sums) {
    const Vec3d areaNormal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double doubleArea = areaNormal.length();
    if (!(doubleArea > 0.0)) return;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d toNext = corners[(i + 1) % 3] - corners[i];
        const Vec3d toPrevious = corners[(i + 2) % 3] - corners[i];
        const double angle = std::atan2(doubleArea, toNext.dot(toPrevious));
        sums[groups[i]] += areaNormal * (angle / doubleArea);
    }
}

}  // namespace

Vec3f triangleNormal(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    return normalizedOr((Vec3d(b) - Vec3d(a)).cross(Vec3d(c) - Vec3d(a)), Vec3f(0.0f));
}

void computeMissingNormals(Mesh& mesh) {
    if (mesh.normals.size() == mesh.positions.size()) return;

    // Number the positions, so that vertices split by a UV seam still share their normal.
    VertexGrouping grouping(mesh.vertexCount());
    std::vector<std::uint32_t> groupOfVertex;
    groupOfVertex.reserve(mesh.vertexCount());
    for (const Vec3f& position : mesh.positions) {
        VertexKey key{};
        putVector(key, 0, position);
        groupOfVertex.push_back(grouping.groupOf(key));
    }

    std::vector<Vec3d> sums(grouping.groupCount(), Vec3d(0.0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        addTriangle({Vec3d(mesh.positions[a]), Vec3d(mesh.positions[b]), Vec3d(mesh.positions[c])},
                    {groupOfVertex[a], groupOfVertex[b], groupOfVertex[c]}, sums);
    }

    mesh.normals.clear();
    mesh.normals.reserve(mesh.vertexCount());
    for (const std::uint32_t group : groupOfVertex) {
        mesh.normals.push_back(normalizedOr(sums[group], Vec3f(0.0f, 1.0f, 0.0f)));
    }
}

}  // namespace prt
