#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/scene/mesh_building.h"
#include "prt/scene/procedural.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;

// The unit sphere from its pole at -z up to the height `top`, seen from outside:
// rows of segmentCount vertices, each on the sphere with its own position as
// normal, and one vertex at a pole.
Mesh makeSphereCap(double top, int segmentCount) {
    PRT_ASSERT(segmentCount >= 3, "a sphere has at least three segments");
    const double highestLatitude = std::asin(top);
    const double arc = highestLatitude + 0.5 * kPi;
    const int rowCount =
        std::max(2, static_cast<int>(std::lround(arc * segmentCount / (2.0 * kPi))));
    const bool closed = top >= 1.0;

    Mesh mesh;
    mesh.positions.push_back(Vec3f(0.0f, 0.0f, -1.0f));
    for (int row = 1; row <= (closed ? rowCount - 1 : rowCount); ++row) {
        const double latitude = highestLatitude - arc * (rowCount - row) / rowCount;
        for (int segment = 0; segment < segmentCount; ++segment) {
            const double azimuth = 2.0 * kPi * segment / segmentCount;
            mesh.positions.push_back(
                Vec3f(Vec3d(std::cos(azimuth) * std::cos(latitude),
                            std::sin(azimuth) * std::cos(latitude), std::sin(latitude))));
        }
    }
    if (closed) mesh.positions.push_back(Vec3f(0.0f, 0.0f, 1.0f));
    mesh.normals = mesh.positions;

    // Join row to row; a row that is a pole gives one triangle a segment instead of two.
    const auto vertexAt = [&](int row, int segment) {
        if (row == 0) return std::uint32_t{0};
        if (closed && row == rowCount) return static_cast<std::uint32_t>(mesh.vertexCount() - 1);
        return static_cast<std::uint32_t>(1 + (row - 1) * segmentCount + segment % segmentCount);
    };
    for (int row = 0; row < rowCount; ++row) {
        for (int segment = 0; segment < segmentCount; ++segment) {
            const std::uint32_t a = vertexAt(row, segment), b = vertexAt(row, segment + 1);
            const std::uint32_t c = vertexAt(row + 1, segment + 1), d = vertexAt(row + 1, segment);
            if (a != b) mesh.indices.insert(mesh.indices.end(), {a, b, c});
            if (c != d) mesh.indices.insert(mesh.indices.end(), {a, c, d});
        }
    }
    return mesh;
}

}  // namespace

Mesh makeSphere(const Vec3f& center, float radius, int segmentCount) {
    Mesh mesh = makeSphereCap(1.0, segmentCount);
    mesh.name = "sphere";
    for (Vec3f& position : mesh.positions)
        position = center + position * radius;
    return mesh;
}

Mesh makeBowl(float openingHeight, int segmentCount) {
    PRT_ASSERT(openingHeight > -1.0f && openingHeight < 1.0f, "the opening cuts the unit sphere");
    Mesh mesh = makeSphereCap(static_cast<double>(openingHeight), segmentCount);
    mesh.name = "bowl";
    turnInsideOut(mesh);
    return mesh;
}

Mesh makeFloor(float halfWidth, float height, int cellCount) {
    Mesh mesh;
    mesh.name = "floor";
    appendQuad(mesh, horizontalQuad(Vec3f(0.0f, height, 0.0f), 2.0f * halfWidth, 2.0f * halfWidth),
               cellCount, cellCount);
    return mesh;
}

Mesh makeBox(const Vec3f& low, const Vec3f& high, bool facingInwards, int cellCount) {
    const auto corner = [&](bool x, bool y, bool z) {
        return Vec3f(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z);
    };
    Mesh mesh;
    mesh.name = "box";
    const Quad base{corner(0, 0, 1), corner(1, 0, 1), corner(1, 0, 0), corner(0, 0, 0)};
    const Quad top{corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0), corner(0, 1, 0)};
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        appendQuad(mesh, {base[i], base[next], top[next], top[i]}, cellCount, cellCount);
    }
    appendQuad(mesh, top, cellCount, cellCount);
    appendQuad(mesh, {base[3], base[2], base[1], base[0]}, cellCount, cellCount);
    if (facingInwards) turnInsideOut(mesh);
    return mesh;
}

}  // namespace prt
