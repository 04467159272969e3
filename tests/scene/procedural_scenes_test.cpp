#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>

#include "prt/base/error.h"
#include "prt/scene/procedural.h"
#include "tests/support/mesh_measures.h"

namespace prt {
namespace {

constexpr float kUnitTolerance = 1e-6f;

class EveryProceduralScene : public testing::TestWithParam<ProceduralScene> {};

TEST_P(EveryProceduralScene, KeepsWhatASceneReaderPromises) {
    const Scene scene = makeProceduralScene(GetParam().name);
    ASSERT_FALSE(scene.meshes.empty());
    for (const Mesh& mesh : scene.meshes) {
        ASSERT_LT(mesh.material, scene.materials.size());
        ASSERT_EQ(mesh.normals.size(), mesh.vertexCount());
        ASSERT_EQ(mesh.indices.size() % 3, 0u);
        for (const std::uint32_t index : mesh.indices)
            ASSERT_LT(index, mesh.vertexCount());
        for (const Vec3f& normal : mesh.normals)
            ASSERT_NEAR(normal.length(), 1.0f, kUnitTolerance);
        EXPECT_FALSE(mesh.name.empty());
    }
    EXPECT_EQ(countFlippedTriangles(scene), 0u);
}

TEST_P(EveryProceduralScene, HasPlausibleAlbedosVerticesForShadowsAndACamera) {
    const Scene scene = makeProceduralScene(GetParam().name);
    EXPECT_GE(scene.vertexCount(), 5000u);
    EXPECT_LE(scene.vertexCount(), 60000u);
    std::set<std::string> names;
    for (const Material& material : scene.materials) {
        EXPECT_TRUE(names.insert(material.name).second) << material.name;
        for (int i = 0; i < 3; ++i) {
            EXPECT_GT(material.baseColorFactor[i], 0.0f);
            EXPECT_LT(material.baseColorFactor[i], 0.9f);
        }
    }
    ASSERT_FALSE(scene.cameras.empty());
    const Camera& camera = scene.cameras[0];
    EXPECT_FALSE(camera.name.empty());
    EXPECT_NEAR(camera.forward.length(), 1.0f, kUnitTolerance);
    EXPECT_NEAR(camera.forward.dot(camera.up), 0.0f, kUnitTolerance);
    EXPECT_FALSE(GetParam().description.empty());
}

std::string testName(const testing::TestParamInfo<ProceduralScene>& parameter) {
    std::string name(parameter.param.name);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(All, EveryProceduralScene,
                         testing::ValuesIn(proceduralScenes().begin(), proceduralScenes().end()),
                         testName);

// Surfaces that touch share their points to the last bit: nothing is open
// but the rim that is meant to be.
void expectOpenOnlyWhere(const Scene& scene, const std::function<bool(const Vec3f&)>& isOnRim) {
    const auto open = findOpenEdges(scene);
    EXPECT_FALSE(open.empty());
    for (const auto& [a, b] : open)
        EXPECT_TRUE(isOnRim(a) && isOnRim(b)) << a << " to " << b;
}

TEST(ProceduralScene, CornellIsOpenOnlyToTheFrontAndTheTop) {
    expectOpenOnlyWhere(makeProceduralScene("cornell"),
                        [](const Vec3f& p) { return p.z == 1.0f || p.y == 2.0f; });
}

TEST(ProceduralScene, TheTeapotsRoomIsOpenOnlyToTheFrontAndTheTop) {
    Scene scene = makeProceduralScene("teapot");
    ASSERT_EQ(scene.meshes[0].name, "teapot");
    EXPECT_GT(computeBounds(sceneOf({scene.meshes[0]})).low.y, 0.0f);
    scene.meshes.erase(scene.meshes.begin());
    expectOpenOnlyWhere(scene, [](const Vec3f& p) { return p.z == 1.5f || p.y == 1.5f; });
}

TEST(ProceduralScene, TheTempleIsOpenOnlyAtTheEdgeOfItsGround) {
    expectOpenOnlyWhere(makeProceduralScene("columns"), [](const Vec3f& p) {
        return p.y == 0.0f && (std::abs(p.x) == 4.5f || std::abs(p.z) == 3.5f);
    });
}

TEST(ProceduralScene, TheBoxIsClosedAndFacesInwards) {
    const Scene scene = makeProceduralScene("box");
    EXPECT_TRUE(findOpenEdges(scene).empty());
    EXPECT_LT(enclosedVolume(scene), 0.0);
}

// The closed forms A6 and A13 are about exactly these shapes.
TEST(ProceduralScene, KnownAnswersHaveTheirShapes) {
    const Scene overPlane = makeProceduralScene("sphere-over-plane");
    ASSERT_EQ(overPlane.meshes[0].name, "sphere");
    for (const Vec3f& p : overPlane.meshes[0].positions) {
        EXPECT_NEAR((p - Vec3f(0.0f, 2.0f, 0.0f)).length(), 1.0f, kUnitTolerance);
    }
    const std::vector<Vec3f>& plane = overPlane.meshes[1].positions;
    EXPECT_NE(std::find(plane.begin(), plane.end(), Vec3f(0.0f)), plane.end());

    const Scene bowl = makeProceduralScene("bowl");
    EXPECT_GE(bowl.triangleCount(), 50000u);
    EXPECT_FLOAT_EQ(bowl.materials[0].baseColorFactor.x, 0.8f);
    for (const Vec3f& p : bowl.meshes[0].positions)
        EXPECT_LE(p.z, 0.0f);
}

TEST(ProceduralScene, MaterialsGoFromMirrorsToMattInMetalAndLacquer) {
    const Scene scene = makeProceduralScene("materials");
    for (const float metallic : {0.0f, 1.0f})
        for (const float roughness : {0.1f, 0.3f, 0.5f, 0.7f, 1.0f})
            EXPECT_TRUE(std::any_of(scene.meshes.begin(), scene.meshes.end(),
                                    [&](const Mesh& m) {
                                        const Material& material = scene.materials[m.material];
                                        return material.metallicFactor == metallic &&
                                               material.roughnessFactor == roughness;
                                    }))
                << metallic << " " << roughness;
}

TEST(ProceduralScene, AnUnknownNameListsThoseThereAre) {
    try {
        makeProceduralScene("teapots");
        FAIL() << "made a scene of an unknown name";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::invalidOption);
        for (const ProceduralScene& scene : proceduralScenes()) {
            EXPECT_NE(error.message().find(scene.name), std::string::npos) << scene.name;
        }
    }
}

}  // namespace
}  // namespace prt
