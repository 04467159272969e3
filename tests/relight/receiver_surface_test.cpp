#include "prt/relight/receiver_surface.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace prt {
namespace {

/// Rough to the left, metallic to the right.
TextureImage makeTwoTexels() {
    TextureImage image;
    image.pixels = Rgba8Image(2, 1);
    image.pixels.at(0, 0) = {0, 255, 51, 255};
    image.pixels.at(1, 0) = {0, 102, 255, 255};
    return image;
}

/// Two quads of two materials; only the second has a texture, and its vertices lie on both texels.
Scene makeScene() {
    const Mesh low = test::makeQuad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    Mesh high = test::makeQuad({0, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 2});
    high.uvSets[0] = {{0.25f, 0.5f}, {0.25f, 0.5f}, {0.75f, 0.5f}, {0.75f, 0.5f}};
    Scene scene = test::assembleScene({{low}, {high}});
    scene.images.push_back(makeTwoTexels());
    scene.materials[0].roughnessFactor = 0.3f;
    scene.materials[1].metallicFactor = 0.5f;
    scene.materials[1].metallicRoughnessTexture = TextureUse{};
    return scene;
}

TEST(ReceiverSurface, IsThatOfTheFirstVertexWithItsTexture) {
    const Scene scene = makeScene();
    CompressedTransfer transfer;
    transfer.receiverCount = 4;
    transfer.receiverOfVertex = {2, 2, 0, 2, 1, 3, 3, 1};
    const std::vector<ReceiverSurface> receivers = describeReceivers(scene, transfer);
    ASSERT_EQ(receivers.size(), 4u);

    EXPECT_EQ(receivers[0].position, Vec3f(1, 1, 0));
    EXPECT_EQ(receivers[2].position, Vec3f(0, 0, 0));
    EXPECT_EQ(receivers[1].position, Vec3f(0, 0, 2));
    EXPECT_EQ(receivers[3].position, Vec3f(0, 1, 2));
    EXPECT_EQ(receivers[0].normal, Vec3f(0, 0, 1));
    EXPECT_EQ(receivers[1].normal, Vec3f(0, 0, -1));
    EXPECT_EQ(receivers[2].material, 0u);
    EXPECT_EQ(receivers[3].material, 1u);
    EXPECT_FLOAT_EQ(receivers[2].surface.roughness, 0.3f);
    EXPECT_FLOAT_EQ(receivers[2].surface.metallic, 0.0f);
    EXPECT_FLOAT_EQ(receivers[1].surface.roughness, 1.0f);
    EXPECT_FLOAT_EQ(receivers[1].surface.metallic, 0.1f);
}

TEST(ReceiverSurface, TakesTheTexelOfItsOwnCorner) {
    const Scene scene = makeScene();
    CompressedTransfer transfer;
    transfer.receiverCount = 8;
    transfer.receiverOfVertex = {0, 1, 2, 3, 4, 5, 6, 7};
    const std::vector<ReceiverSurface> receivers = describeReceivers(scene, transfer);
    for (const std::size_t left : {4, 5})
        EXPECT_FLOAT_EQ(receivers[left].surface.metallic, 0.1f);
    for (const std::size_t right : {6, 7}) {
        EXPECT_FLOAT_EQ(receivers[right].surface.roughness, 0.4f);
        EXPECT_FLOAT_EQ(receivers[right].surface.metallic, 0.5f);
    }
}

TEST(ReceiverSurface, OfAVertexWithoutATriangleIsItsMaterial) {
    Scene scene = makeScene();
    scene.meshes[1].indices.clear();
    CompressedTransfer transfer;
    transfer.receiverCount = 2;
    transfer.receiverOfVertex = {0, 0, 0, 0, 1, 1, 1, 1};
    const std::vector<ReceiverSurface> receivers = describeReceivers(scene, transfer);
    EXPECT_EQ(receivers[1].position, Vec3f(0, 0, 2));
    EXPECT_FLOAT_EQ(receivers[1].surface.metallic, 0.5f);
    EXPECT_FLOAT_EQ(receivers[1].surface.roughness, 1.0f);
}

}  // namespace
}  // namespace prt
