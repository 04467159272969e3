#include "apps/viewer/placed_scene.h"

#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace prt::viewer {
namespace {

/// A quad with a texture of its own, behind a material without one.
std::shared_ptr<const Asset> makePicture(std::uint8_t red) {
    auto asset = std::make_shared<Asset>();
    Scene& scene = asset->scene;
    scene = test::assembleScene({{test::makeQuad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0})},
                                 {test::makeQuad({0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1})}});
    scene.materials[1].baseColorTexture = TextureUse{};
    scene.materials[1].emissiveTexture = TextureUse{};
    scene.images = {{.name = "red", .mimeType = "image/png", .encoded = {}, .pixels = {}}};
    scene.images[0].pixels = Rgba8Image(1, 1, {red, 0, 0, 255});
    return asset;
}

TEST(PlacedScene, EachAssetKeepsItsMaterialsAndImages) {
    const PlacedAsset placed[] = {{makePicture(10)}, {makePicture(20)}, {makePicture(30)}};
    const Scene scene = assembleWorld(placed);
    ASSERT_EQ(scene.meshes.size(), 6u);
    for (std::size_t mesh = 0; mesh < 6; ++mesh) {
        const Material& material = scene.materials[scene.meshes[mesh].material];
        EXPECT_EQ(material.baseColorTexture.has_value(), mesh % 2 == 1);
        EXPECT_FALSE(material.metallicRoughnessTexture);
        if (mesh % 2 == 0) continue;
        const int red = 10 * static_cast<int>(mesh / 2 + 1);
        EXPECT_EQ(scene.images[material.baseColorTexture->image].pixels.at(0, 0).red, red);
        EXPECT_EQ(scene.images[material.emissiveTexture->image].pixels.at(0, 0).red, red);
    }
}

TEST(PlacedScene, PositionsAndNormalsAreTurnedAndOnlyPositionsMoved) {
    const PlacedAsset placed{makePicture(1), {rotationY(0.5 * std::numbers::pi), {0, 0, 5}}};
    const Scene scene = assembleWorld({&placed, 1});
    // +z goes to +x, +x to −z.
    EXPECT_TRUE(scene.meshes[0].normals[0].equalWithAbsError({1, 0, 0}, 1e-6f));
    EXPECT_TRUE(scene.meshes[1].positions[1].equalWithAbsError({1, 0, 4}, 1e-6f));
}

}  // namespace
}  // namespace prt::viewer
