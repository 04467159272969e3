#include "prt/scene/check_scene.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "prt/scene/normals.h"
#include "prt/scene/weld.h"

namespace prt {
namespace {

/// A triangle by its corners' places, ascending: the same whichever way it faces.
using Places = std::array<std::uint32_t, 3>;

struct Counts {
    std::size_t flatTriangles = 0;
    std::size_t coincidentTriangles = 0;
    std::size_t looseVertices = 0;
};

/// How many stand in the list once more.
std::size_t countRepetitions(std::vector<Places>& triangles) {
    std::sort(triangles.begin(), triangles.end());
    std::size_t count = 0;
    for (std::size_t i = 1; i < triangles.size(); ++i)
        count += triangles[i] == triangles[i - 1];
    return count;
}

Counts countOddities(const Scene& scene) {
    const Welding welding = weldPositions(scene);
    std::vector<bool> isUsed(scene.vertexCount(), false);
    std::vector<Places> triangles;
    triangles.reserve(scene.triangleCount());
    Counts counts;
    std::size_t firstVertex = 0;
    for (const Mesh& mesh : scene.meshes) {
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const std::uint32_t* corners = &mesh.indices[i];
            const Vec3f normal = triangleNormal(
                mesh.positions[corners[0]], mesh.positions[corners[1]], mesh.positions[corners[2]]);
            if (normal == Vec3f(0.0f)) {
                ++counts.flatTriangles;
                continue;
            }
            Places places{};
            for (std::size_t k = 0; k < 3; ++k) {
                isUsed[firstVertex + corners[k]] = true;
                places[k] = welding.groupOfVertex[firstVertex + corners[k]];
            }
            std::sort(places.begin(), places.end());
            triangles.push_back(places);
        }
        firstVertex += mesh.vertexCount();
    }
    counts.coincidentTriangles = countRepetitions(triangles);
    counts.looseVertices =
        static_cast<std::size_t>(std::count(isUsed.begin(), isUsed.end(), false));
    return counts;
}

/// "1 triangle has", "2 triangles have"; nothing for 0.
void addProblem(std::vector<std::string>& problems, std::size_t count, const std::string& one,
                const std::string& many) {
    if (count > 0) problems.push_back(std::to_string(count) + " " + (count == 1 ? one : many));
}

}  // namespace

std::vector<std::string> findSceneProblems(const Scene& scene) {
    const Counts counts = countOddities(scene);
    std::vector<std::string> problems;
    addProblem(problems, counts.flatTriangles, "triangle has no area, and no ray meets it",
               "triangles have no area, and no ray meets them");
    addProblem(problems, counts.coincidentTriangles, "triangle lies exactly on another",
               "triangles lie exactly on others");
    addProblem(problems, counts.looseVertices, "vertex belongs to no triangle with an area",
               "vertices belong to no triangle with an area");
    return problems;
}

}  // namespace prt
