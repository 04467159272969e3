#include "prt/scene/weld.h"

#include <gtest/gtest.h>

#include "prt/base/random.h"
#include "prt/scene/procedural.h"
#include "tests/support/mesh_measures.h"

namespace prt {
namespace {

// Vertices without triangles, of so few different values that most coincide.
Mesh makeVertexSoup(std::size_t vertexCount, RandomStream& random) {
    const auto coordinate = [&] {
        constexpr float kValues[] = {0.0f, -0.0f, 1.0f, 1.0000001f};
        return kValues[random.nextBits() % 4];
    };
    Mesh mesh;
    for (std::size_t i = 0; i < vertexCount; ++i) {
        mesh.positions.emplace_back(coordinate(), coordinate(), coordinate());
        mesh.normals.emplace_back(random.nextBits() % 2 == 0 ? Vec3f(0.0f, 1.0f, 0.0f)
                                                             : Vec3f(-0.0f, 1.0f, 0.0f));
        if (random.nextBits() % 2 == 0) mesh.normals.back() = Vec3f(1.0f, 0.0f, 0.0f);
    }
    return mesh;
}

struct Vertex {
    Vec3f position;
    Vec3f normal;
    bool doubleSided;
};

std::vector<Vertex> listVertices(const Scene& scene) {
    std::vector<Vertex> vertices;
    for (const Mesh& mesh : scene.meshes) {
        for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
            vertices.push_back(
                {mesh.positions[i], mesh.normals[i], scene.materials[mesh.material].doubleSided});
        }
    }
    return vertices;
}

// Compares every vertex with all before it.
template <class Same>
void expectGroups(const Welding& welding, const std::vector<Vertex>& vertices, const Same& same) {
    std::vector<std::uint32_t> firstOfGroup, groupOfVertex;
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        std::uint32_t group = 0;
        while (group < firstOfGroup.size() && !same(vertices[firstOfGroup[group]], vertices[i]))
            ++group;
        if (group == firstOfGroup.size()) firstOfGroup.push_back(i);
        groupOfVertex.push_back(group);
    }
    EXPECT_EQ(welding.vertexOfGroup, firstOfGroup);
    EXPECT_EQ(welding.groupOfVertex, groupOfVertex);
}

TEST(Weld, GroupsAreThoseOfComparingEveryPair) {
    RandomStream random(1, 2);
    Scene scene = sceneOf({makeVertexSoup(200, random), makeVertexSoup(1, random), Mesh{},
                           makeVertexSoup(300, random)});
    scene.materials.resize(2);
    scene.materials[1].doubleSided = true;
    scene.meshes[3].material = 1;
    const std::vector<Vertex> vertices = listVertices(scene);
    expectGroups(weldVertices(scene), vertices, [](const Vertex& a, const Vertex& b) {
        return a.position == b.position && a.normal == b.normal && a.doubleSided == b.doubleSided;
    });
    expectGroups(weldPositions(scene), vertices,
                 [](const Vertex& a, const Vertex& b) { return a.position == b.position; });
}

TEST(Weld, ABoxHasEightCornersAndTwentyFourNormalsAtThem) {
    const Scene scene = sceneOf({makeBox(Vec3f(-1.0f), Vec3f(2.0f), false, 1)});
    EXPECT_EQ(weldPositions(scene).vertexOfGroup.size(), 8u);
    EXPECT_EQ(weldVertices(scene).vertexOfGroup.size(), 24u);
}

TEST(Weld, UvsColoursAndMaterialsMayDiffer) {
    Mesh a = makeFloor(1.0f, 0.0f, 4), b = a;
    a.uvSets[0].assign(a.vertexCount(), Vec2f(0.0f));
    b.colors.assign(b.vertexCount(), Vec4f(0.5f));
    b.material = 1;
    Scene scene = sceneOf({a, b});
    scene.materials.resize(2);
    EXPECT_EQ(weldVertices(scene).vertexOfGroup.size(), a.vertexCount());
    scene.materials[1].doubleSided = true;
    EXPECT_EQ(weldVertices(scene).vertexOfGroup.size(), 2 * a.vertexCount());
    EXPECT_EQ(weldPositions(scene).vertexOfGroup.size(), a.vertexCount());
}

TEST(Weld, AnEmptySceneHasNoGroups) {
    EXPECT_TRUE(weldVertices(Scene{}).groupOfVertex.empty());
    EXPECT_TRUE(weldPositions(Scene{}).vertexOfGroup.empty());
}

}  // namespace
}  // namespace prt
