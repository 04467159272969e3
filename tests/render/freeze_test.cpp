#include "prt/render/freeze.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "prt/base/random.h"
#include "prt/render/render_view.h"
#include "prt/scene/framing.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

using test::assembleScene;
using test::makeQuad;
using test::makeRoomScene;

// A few roundings of a float, of numbers up to 1.
constexpr float kRounding = 1e-6f;
constexpr DisplayOptions kPlain{.toneCurve = ToneCurve::none};

Mesh makeWall() {
    return makeQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
}

std::vector<Vec3f> makeRandomRadiance(const Scene& scene) {
    RandomStream random(7, 0);
    std::vector<Vec3f> radiance(scene.vertexCount());
    for (Vec3f& value : radiance)
        for (int c = 0; c < 3; ++c)
            value[c] = random.nextUnitFloat();
    return radiance;
}

/// A white and a black texel beside one another.
TextureImage makeTwoTexels() {
    TextureImage image;
    image.pixels = Rgba8Image(2, 1);
    image.pixels.at(1, 0) = {0, 0, 0, 255};
    image.pixels.at(0, 0) = {255, 255, 255, 255};
    return image;
}

Vec3f rgbOf(const Vec4f& color) {
    return {color.x, color.y, color.z};
}

/// What a viewer shows that multiplies vertex colours with textures and adds no light.
Image showUnlit(Scene scene, const Camera& camera, const RenderOptions& options) {
    std::vector<Vec3f> colors;
    for (Mesh& mesh : scene.meshes) {
        for (const Vec4f& color : mesh.colors)
            colors.push_back(rgbOf(color));
        mesh.colors.clear();
    }
    return renderView(scene, RayScene(scene), colors, camera, options);
}

TEST(FreezeScene, AViewerWithoutLightShowsTheSamePicture) {
    Scene scene = makeRoomScene();
    scene.images = {TextureImage{}, makeTwoTexels()};
    scene.materials[0].baseColorTexture = TextureUse{.image = 1, .uvSet = 1};
    scene.meshes[0].uvSets[1] = {{0.1f, 0.0f}, {0.9f, 0.0f}, {1.3f, 1.0f}, {0.2f, 1.0f}};
    scene.materials[1].emissiveFactor = Vec3f(0.2f, 0.5f, 0.1f);
    scene.materials[2].emissiveFactor = Vec3f(1.0f);
    scene.materials[2].emissiveTexture = TextureUse{.image = 1};
    scene.meshes[2].uvSets[0].assign(4, {0.25f, 0.5f});
    scene.meshes[1].colors.assign(4, Vec4f(0.5f, 1.0f, 0.25f, 1.0f));
    const std::vector<Vec3f> radiance = makeRandomRadiance(scene);
    const Camera camera = lookAt(Vec3f(1.5f, 0.2f, 3.5f), Vec3f(0.0f, 0.0f, 0.8f), 0.9f);
    const RenderOptions options{.width = 48, .height = 32, .samplesPerAxis = 2, .threadCount = 1};
    const Image expected = renderView(scene, RayScene(scene), radiance, camera, options);

    const Scene frozen = freezeScene(scene, radiance, {-1.0f, ToneCurve::none});
    EXPECT_TRUE(frozen.warnings.empty());
    const Image shown = showUnlit(frozen, camera, options);
    float brightest = 0.0f;
    for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
        brightest = std::max(brightest, shown.pixels[i].x);
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(shown.pixels[i][c], 0.5f * expected.pixels[i][c], kRounding) << i;
    }
    EXPECT_GT(brightest, 0.4f);
}

TEST(FreezeScene, ColoursAreExposedThenCurvedThenClamped) {
    const Scene scene = assembleScene({{makeWall(), {0.5f, 0.25f, 1.0f}}});
    const std::vector<Vec3f> radiance = {{0.1f, 0.4f, -1.0f}, {3.0f, 8.0f, 20.0f}, {}, {}};
    const std::vector<Vec4f> plain =
        freezeScene(scene, radiance, {1.0f, ToneCurve::none}).meshes[0].colors;
    EXPECT_LT((plain[0] - Vec4f(0.1f, 0.2f, 0.0f, 1.0f)).length(), kRounding);
    EXPECT_EQ(plain[1], Vec4f(1.0f, 1.0f, 1.0f, 1.0f));
    EXPECT_EQ(plain[2], Vec4f(0.0f, 0.0f, 0.0f, 1.0f));
    const float curved = freezeScene(scene, radiance).meshes[0].colors[0].y;
    const float x = 0.1f;  // [Narkowicz15]
    EXPECT_NEAR(curved, x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), kRounding);
}

TEST(FreezeScene, AlbedoIsClampedAsThatOfAPicture) {
    Scene scene = assembleScene({{makeWall(), {2.0f, 0.5f, 0.5f}}});
    scene.meshes[0].colors.assign(4, Vec4f(1.0f, 3.0f, 1.0f, 1.0f));
    const std::vector<Vec3f> radiance(4, Vec3f(0.25f));
    const Vec4f color = freezeScene(scene, radiance, kPlain).meshes[0].colors[0];
    EXPECT_EQ(color, Vec4f(0.25f, 0.25f, 0.125f, 1.0f));
}

/// A wall of all that a material can have.
Scene makeDecoratedWall() {
    Scene scene = assembleScene({{makeWall(), {0.5f, 0.5f, 0.5f}}});
    scene.images = {makeTwoTexels(), makeTwoTexels(), makeTwoTexels()};
    scene.images[2].name = "paint";
    Material& material = scene.materials[0];
    material.name = "wall";
    material.baseColorFactor.w = 0.75f;
    material.baseColorTexture =
        TextureUse{.image = 2, .uvSet = 1, .filter = TextureFilter::nearest};
    material.emissiveFactor = Vec3f(1.0f, 0.0f, 0.0f);
    material.emissiveTexture = TextureUse{.image = 0};
    material.metallicRoughnessTexture = TextureUse{.image = 1};
    material.metallicFactor = 1.0f;
    material.alphaMode = AlphaMode::mask;
    material.alphaCutoff = 0.25f;
    material.doubleSided = true;
    Mesh& mesh = scene.meshes[0];
    mesh.uvSets[0].assign(4, {0.25f, 0.5f});
    mesh.uvSets[1] = {{0.25f, 0.5f}, {0.75f, 0.5f}, {0.75f, 0.5f}, {0.25f, 0.5f}};
    mesh.colors.assign(4, Vec4f(1.0f, 1.0f, 1.0f, 0.5f));
    return scene;
}

TEST(FreezeScene, OfMapsOnlyBaseColourStaysAndLostEmissionIsTold) {
    const Scene scene = makeDecoratedWall();
    const Scene frozen = freezeScene(scene, std::vector<Vec3f>(4, Vec3f(1.0f)), kPlain);
    ASSERT_EQ(frozen.images.size(), 1u);
    EXPECT_EQ(frozen.images[0].name, "paint");
    const Material& material = frozen.materials[0];
    EXPECT_EQ(material.name, "wall");
    EXPECT_EQ(material.baseColorFactor, Vec4f(1.0f, 1.0f, 1.0f, 0.75f));
    ASSERT_TRUE(material.baseColorTexture);
    EXPECT_EQ(material.baseColorTexture->image, 0u);
    EXPECT_EQ(material.baseColorTexture->uvSet, 0);
    EXPECT_EQ(material.baseColorTexture->filter, TextureFilter::nearest);
    EXPECT_FALSE(material.emissiveTexture);
    EXPECT_FALSE(material.metallicRoughnessTexture);
    EXPECT_EQ(material.emissiveFactor, Vec3f(0.0f));
    EXPECT_EQ(material.metallicFactor, 0.0f);
    EXPECT_EQ(material.alphaMode, AlphaMode::mask);
    EXPECT_EQ(material.alphaCutoff, 0.25f);
    EXPECT_TRUE(material.doubleSided);
    EXPECT_EQ(frozen.meshes[0].uvSets[0], scene.meshes[0].uvSets[1]);
    EXPECT_TRUE(frozen.meshes[0].uvSets[1].empty());
    EXPECT_EQ(frozen.meshes[0].colors[1], Vec4f(0.5f, 0.5f, 0.5f, 0.5f));
    ASSERT_EQ(frozen.warnings.size(), 1u);
    EXPECT_NE(frozen.warnings[0].find("material 0"), std::string::npos);
}

TEST(FreezeView, VerticesHoldAllThatTheEyeSees) {
    const Scene scene = makeDecoratedWall();
    const ExitRadiance exit{.perBaseColor = Vec3f(0.4f), .constant = Vec3f(0.0f, 0.1f, 0.2f)};
    const Scene frozen = freezeView(scene, std::vector<ExitRadiance>(4, exit),
                                    Vec3f(0.0f, 0.0f, 3.0f), nullptr, {-1.0f, ToneCurve::none});
    EXPECT_TRUE(frozen.images.empty());
    EXPECT_TRUE(frozen.warnings.empty());
    EXPECT_FALSE(frozen.materials[0].baseColorTexture);
    EXPECT_EQ(frozen.materials[0].baseColorFactor, Vec4f(1.0f));
    const std::vector<Vec4f>& colors = frozen.meshes[0].colors;
    // (0.5 · texel · 0.4 + constant + emission) / 2; all of the emission's texels are white.
    EXPECT_LT((colors[0] - Vec4f(0.6f, 0.15f, 0.2f, 0.375f)).length(), kRounding);
    EXPECT_LT((colors[1] - Vec4f(0.5f, 0.05f, 0.1f, 0.375f)).length(), kRounding);
}

}  // namespace
}  // namespace prt
