#include "prt/scene/check_scene.h"

#include <gtest/gtest.h>

#include <limits>

#include "prt/scene/procedural.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

using Sentences = std::vector<std::string>;

/// A square of two triangles in the plane z = 0.
Scene makeSquare() {
    return test::assembleScene({{test::makeQuad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0})}});
}

TEST(CheckScene, ASoundSceneHasNoProblems) {
    EXPECT_EQ(findSceneProblems(makeSquare()), Sentences{});
    EXPECT_EQ(findSceneProblems(Scene()), Sentences{});
    for (const ProceduralScene& scene : proceduralScenes())
        EXPECT_EQ(findSceneProblems(scene.make()), Sentences{}) << scene.name;
}

TEST(CheckScene, TrianglesWithoutAreaAreCounted) {
    Scene scene = makeSquare();
    scene.meshes[0].indices.insert(scene.meshes[0].indices.end(), {0, 0, 1});
    EXPECT_EQ(findSceneProblems(scene), Sentences{"1 triangle has no area, and no ray meets it"});
    scene.meshes[0].indices.insert(scene.meshes[0].indices.end(), {2, 2, 2});
    EXPECT_EQ(findSceneProblems(scene),
              Sentences{"2 triangles have no area, and no ray meets them"});
}

TEST(CheckScene, CoincidentTrianglesAreCountedWhicheverWayTheyFace) {
    Scene scene = makeSquare();
    scene.meshes.push_back(scene.meshes[0]);
    std::swap(scene.meshes[1].indices[0], scene.meshes[1].indices[1]);
    EXPECT_EQ(findSceneProblems(scene), Sentences{"2 triangles lie exactly on others"});
    scene.meshes[1].indices.resize(3);
    EXPECT_EQ(findSceneProblems(scene),
              (Sentences{"1 triangle lies exactly on another",
                         "1 vertex belongs to no triangle with an area"}));
}

TEST(CheckScene, LooseVerticesAreCounted) {
    Scene scene = makeSquare();
    scene.meshes[0].positions.assign(6, Vec3f(5, 5, 5));
    scene.meshes[0].normals.assign(6, Vec3f(0, 0, 1));
    EXPECT_EQ(findSceneProblems(scene),
              (Sentences{"2 triangles have no area, and no ray meets them",
                         "6 vertices belong to no triangle with an area"}));
}

TEST(CheckScene, SizeDoesNotMatter) {
    for (const float scale : {1e-30f, 1e18f, 1e38f}) {
        Scene scene = makeSquare();
        for (Vec3f& position : scene.meshes[0].positions)
            position *= scale;
        EXPECT_EQ(findSceneProblems(scene), Sentences{}) << scale;
    }
}

}  // namespace
}  // namespace prt
