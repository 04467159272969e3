#include "prt/scene/mesh_building.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "prt/base/assert.h"
#include "prt/scene/normals.h"

namespace prt {
namespace {

// The point i/n of the way from a to b; the same bits as (n−i)/n of the way from b to a.
Vec3d divide(const Vec3d& a, const Vec3d& b, int i, int n) {
    return a * (static_cast<double>(n - i) / n) + b * (static_cast<double>(i) / n);
}

Vec3f divide(const Vec3f& a, const Vec3f& b, int i, int n) {
    return Vec3f(divide(Vec3d(a), Vec3d(b), i, n));
}

std::uint32_t addVertex(Mesh& mesh, const Vec3f& position, const Vec3f& normal) {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    return static_cast<std::uint32_t>(mesh.vertexCount() - 1);
}

void addTriangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

// Joins the last rowCount rows of columnCount vertices into a grid;
// rows go up where columns go right.
void addGrid(Mesh& mesh, int rowCount, int columnCount, bool closed) {
    const std::size_t first = mesh.vertexCount() - static_cast<std::size_t>(rowCount * columnCount);
    const auto vertexAt = [&](int row, int column) {
        return static_cast<std::uint32_t>(first) +
               static_cast<std::uint32_t>(row * columnCount + column % columnCount);
    };
    for (int row = 0; row + 1 < rowCount; ++row) {
        for (int column = 0; column < (closed ? columnCount : columnCount - 1); ++column) {
            const std::uint32_t a = vertexAt(row, column), b = vertexAt(row, column + 1);
            const std::uint32_t c = vertexAt(row + 1, column + 1), d = vertexAt(row + 1, column);
            addTriangle(mesh, a, b, c);
            addTriangle(mesh, a, c, d);
        }
    }
}

}  // namespace

void appendMesh(Mesh& mesh, const Mesh& addition) {
    const auto first = static_cast<std::uint32_t>(mesh.vertexCount());
    mesh.positions.insert(mesh.positions.end(), addition.positions.begin(),
                          addition.positions.end());
    mesh.normals.insert(mesh.normals.end(), addition.normals.begin(), addition.normals.end());
    for (const std::uint32_t index : addition.indices)
        mesh.indices.push_back(first + index);
}

void turnInsideOut(Mesh& mesh) {
    for (Vec3f& normal : mesh.normals)
        normal = -normal;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    }
}

void appendQuad(Mesh& mesh, const Quad& quad, int alongCount, int acrossCount) {
    PRT_ASSERT(alongCount > 0 && acrossCount > 0, "a grid has cells");
    const Vec3f normal = triangleNormal(quad[0], quad[1], quad[2]);
    for (int row = 0; row <= acrossCount; ++row) {
        for (int column = 0; column <= alongCount; ++column) {
            const Vec3d low = divide(Vec3d(quad[0]), Vec3d(quad[1]), column, alongCount);
            const Vec3d high = divide(Vec3d(quad[3]), Vec3d(quad[2]), column, alongCount);
            addVertex(mesh, Vec3f(divide(low, high, row, acrossCount)), normal);
        }
    }
    addGrid(mesh, acrossCount + 1, alongCount + 1, false);
}

void appendTriangle(Mesh& mesh, const std::array<Vec3f, 3>& corners, int cellCount) {
    PRT_ASSERT(cellCount > 0, "a grid has cells");
    const Vec3f normal = triangleNormal(corners[0], corners[1], corners[2]);

    // Row after row from the first edge, each a vertex shorter, up to the third corner.
    std::uint32_t below = 0;
    for (int row = 0; row <= cellCount; ++row) {
        const int rowCells = cellCount - row;
        const auto first = static_cast<std::uint32_t>(mesh.vertexCount());
        const Vec3f left = divide(corners[0], corners[2], row, cellCount);
        const Vec3f right = divide(corners[1], corners[2], row, cellCount);
        for (int i = 0; i <= rowCells; ++i) {
            addVertex(mesh, rowCells > 0 ? divide(left, right, i, rowCells) : corners[2], normal);
        }
        for (std::uint32_t i = 0; row > 0 && i <= static_cast<std::uint32_t>(rowCells); ++i) {
            addTriangle(mesh, below + i, below + i + 1, first + i);
            if (i > 0) addTriangle(mesh, below + i, first + i, first + i - 1);
        }
        below = first;
    }
}

void appendRing(Mesh& mesh, const Polyline& outer, const Polyline& inner, int cellCount) {
    PRT_ASSERT(outer.size() == inner.size() && outer.size() >= 3,
               "the loops have equally many points");
    const Vec3f normal = triangleNormal(outer[0], outer[1], inner[1]);
    for (int row = 0; row <= cellCount; ++row) {
        for (std::size_t i = 0; i < outer.size(); ++i) {
            addVertex(mesh, divide(outer[i], inner[i], row, cellCount), normal);
        }
    }
    addGrid(mesh, cellCount + 1, static_cast<int>(outer.size()), true);
}

void appendPrismSides(Mesh& mesh, const Quad& base, float height, int cellsAround, int cellsUp) {
    const Vec3f up(0.0f, height, 0.0f);
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3f& a = base[i];
        const Vec3f& b = base[(i + 1) % 4];
        appendQuad(mesh, {a, b, b + up, a + up}, cellsAround, cellsUp);
    }
}

void appendTaper(Mesh& mesh, const Taper& taper, int cellsAround, int cellsUp) {
    const Polyline base = circleLoop(taper.baseCenter, taper.baseRadius, cellsAround);
    const Vec3f topCenter = taper.baseCenter + Vec3f(0.0f, taper.height, 0.0f);
    const Polyline top = circleLoop(topCenter, taper.topRadius, cellsAround);
    const float lean = (taper.baseRadius - taper.topRadius) / taper.height;
    for (int row = 0; row <= cellsUp; ++row) {
        for (std::size_t i = 0; i < base.size(); ++i) {
            const Vec3f outwards = (base[i] - taper.baseCenter).normalized();
            addVertex(mesh, divide(base[i], top[i], row, cellsUp),
                      (outwards + Vec3f(0.0f, lean, 0.0f)).normalized());
        }
    }
    addGrid(mesh, cellsUp + 1, cellsAround, true);
}

Polyline quadLoop(const Quad& quad, int cellCount) {
    Polyline loop;
    for (std::size_t edge = 0; edge < 4; ++edge) {
        for (int i = 0; i < cellCount; ++i) {
            loop.push_back(divide(quad[edge], quad[(edge + 1) % 4], i, cellCount));
        }
    }
    return loop;
}

Polyline circleLoop(const Vec3f& center, float radius, int pointCount) {
    constexpr double kFirstAngle = 1.25 * std::numbers::pi;
    Polyline loop;
    for (int i = 0; i < pointCount; ++i) {
        const double angle = kFirstAngle + 2.0 * std::numbers::pi * i / pointCount;
        const Vec3d outwards(std::cos(angle), 0.0, -std::sin(angle));
        loop.push_back(Vec3f(Vec3d(center) + outwards * static_cast<double>(radius)));
    }
    return loop;
}

Quad horizontalQuad(const Vec3f& center, float width, float depth, float angleRadians) {
    const Vec3f right =
        Vec3f(std::cos(angleRadians), 0.0f, -std::sin(angleRadians)) * (0.5f * width);
    const Vec3f front =
        Vec3f(std::sin(angleRadians), 0.0f, std::cos(angleRadians)) * (0.5f * depth);
    return {center - right + front, center + right + front, center + right - front,
            center - right - front};
}

}  // namespace prt
