#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "prt/scene/scene.h"
#include "prt/scene/weld.h"

// Slow and plain measures of meshes for the tests.

namespace prt {

inline Scene sceneOf(std::vector<Mesh> meshes) {
    Scene scene;
    scene.meshes = std::move(meshes);
    scene.materials.resize(1);
    return scene;
}

/// Calls visit(a, b, c) with the corner positions of each triangle.
template <class Visitor>
void forEachTriangle(const Scene& scene, const Visitor& visit) {
    for (const Mesh& mesh : scene.meshes) {
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            visit(Vec3d(mesh.positions[mesh.indices[i]]),
                  Vec3d(mesh.positions[mesh.indices[i + 1]]),
                  Vec3d(mesh.positions[mesh.indices[i + 2]]));
        }
    }
}

inline double surfaceArea(const Scene& scene) {
    double area = 0.0;
    forEachTriangle(scene, [&](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
        area += 0.5 * (b - a).cross(c - a).length();
    });
    return area;
}

/// Positive for a closed surface that faces outwards.
inline double enclosedVolume(const Scene& scene) {
    double volume = 0.0;
    forEachTriangle(scene, [&](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
        volume += a.dot(b.cross(c)) / 6.0;
    });
    return volume;
}

inline double longestEdge(const Scene& scene) {
    double longest = 0.0;
    forEachTriangle(scene, [&](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
        longest = std::max({longest, (b - a).length(), (c - b).length(), (a - c).length()});
    });
    return longest;
}

inline double smallestAngleDegrees(const Scene& scene) {
    double smallest = 180.0;
    forEachTriangle(scene, [&](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
        for (const auto& [p, q, r] :
             {std::array{a, b, c}, std::array{b, c, a}, std::array{c, a, b}}) {
            smallest =
                std::min(smallest, std::atan2((q - p).cross(r - p).length(), (q - p).dot(r - p)) *
                                       57.29577951308232);
        }
    });
    return smallest;
}

/// The edges, by position to the last bit, that are not run through equally often in both
/// directions: the rim of the surface, and every crack and T-junction in it.
inline std::vector<std::array<Vec3f, 2>> findOpenEdges(const Scene& scene) {
    const Welding welding = weldPositions(scene);
    std::vector<Vec3f> positions;
    for (const Mesh& mesh : scene.meshes) {
        positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
    }
    std::map<std::array<std::uint32_t, 2>, int> balance;
    std::size_t firstVertex = 0;
    for (const Mesh& mesh : scene.meshes) {
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
            const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
            const std::uint32_t from = welding.groupOfVertex[firstVertex + mesh.indices[i]];
            const std::uint32_t to = welding.groupOfVertex[firstVertex + mesh.indices[next]];
            balance[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : from > to ? -1 : 0;
        }
        firstVertex += mesh.vertexCount();
    }
    std::vector<std::array<Vec3f, 2>> open;
    for (const auto& [edge, count] : balance) {
        if (count == 0) continue;
        open.push_back(
            {positions[welding.vertexOfGroup[edge[0]]], positions[welding.vertexOfGroup[edge[1]]]});
    }
    return open;
}

/// Triangles whose winding disagrees with the normals of their corners.
inline std::size_t countFlippedTriangles(const Scene& scene) {
    std::size_t flipped = 0;
    for (const Mesh& mesh : scene.meshes) {
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1],
                                c = mesh.indices[i + 2];
            const Vec3d winding = (Vec3d(mesh.positions[b]) - Vec3d(mesh.positions[a]))
                                      .cross(Vec3d(mesh.positions[c]) - Vec3d(mesh.positions[a]));
            for (const std::uint32_t corner : {a, b, c}) {
                if (!(winding.dot(Vec3d(mesh.normals[corner])) > 0.0)) {
                    ++flipped;
                    break;
                }
            }
        }
    }
    return flipped;
}

}  // namespace prt
