#include "prt/scene/surface_color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "prt/base/random.h"
#include "prt/image/tone_curve.h"
#include "tests/support/mesh_measures.h"

namespace prt {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kRounding =
    2e-6f;  // of texture coordinates up to 3 times 7 texels, and of the blend

void expectNear(const Vec4f& actual, const Vec4f& expected, float tolerance = kRounding) {
    for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(actual[i], expected[i], tolerance) << "channel " << i;
}

Vec4f decode(const Rgba8& texel) {
    return Vec4f(decodeSrgb(static_cast<float>(texel.red) / 255.0f),
                 decodeSrgb(static_cast<float>(texel.green) / 255.0f),
                 decodeSrgb(static_cast<float>(texel.blue) / 255.0f),
                 static_cast<float>(texel.alpha) / 255.0f);
}

// One triangle whose corners have the UVs (0, 0), (1, 0), (0, 1), so
// that a point's (u, v) is its UV.
Scene makeTexturedTriangle(const Rgba8Image& image) {
    Mesh mesh;
    mesh.positions = {Vec3f(0.0f), Vec3f(1.0f, 0.0f, 0.0f), Vec3f(0.0f, 1.0f, 0.0f)};
    mesh.uvSets[0] = {Vec2f(0.0f, 0.0f), Vec2f(1.0f, 0.0f), Vec2f(0.0f, 1.0f)};
    mesh.indices = {0, 1, 2};
    Scene scene = sceneOf({mesh});
    scene.images.resize(1);
    scene.images[0].pixels = image;
    scene.materials[0].baseColorTexture = TextureUse{};
    return scene;
}

Rgba8Image makeRandomImage(int width, int height, std::uint64_t seed) {
    RandomStream random(seed, 0);
    Rgba8Image image(width, height);
    for (Rgba8& texel : image.pixels) {
        const std::uint32_t bits = random.nextBits();
        texel = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8),
                 static_cast<std::uint8_t>(bits >> 16), static_cast<std::uint8_t>(bits >> 24)};
    }
    return image;
}

// The texel at any whole number of an endlessly repeated, mirrored or held row of `size` texels.
int wrapSlowly(int i, int size, TextureWrap wrap) {
    if (wrap == TextureWrap::clampToEdge) return i < 0 ? 0 : i >= size ? size - 1 : i;
    const int period = wrap == TextureWrap::repeat ? size : 2 * size;
    while (i < 0)
        i += period;
    while (i >= period)
        i -= period;
    return i < size ? i : 2 * size - 1 - i;
}

// Filters on the endless plane of texels, whose centres lie at whole numbers plus one half.
Vec4f sampleSlowly(const Rgba8Image& image, const TextureUse& texture, const Vec2f& uv) {
    const auto texelAt = [&](int x, int y) {
        return decode(image.at(wrapSlowly(x, image.width, texture.wrapU),
                               wrapSlowly(y, image.height, texture.wrapV)));
    };
    const double x = static_cast<double>(uv.x) * image.width,
                 y = static_cast<double>(uv.y) * image.height;
    if (texture.filter == TextureFilter::nearest) {
        return texelAt(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
    }
    Vec4f sum(0.0f);
    const int firstX = static_cast<int>(std::floor(x)) - 2,
              firstY = static_cast<int>(std::floor(y)) - 2;
    for (int j = firstY; j < firstY + 5; ++j) {
        for (int i = firstX; i < firstX + 5; ++i) {
            const double weight = std::max(0.0, 1.0 - std::abs(x - i - 0.5)) *
                                  std::max(0.0, 1.0 - std::abs(y - j - 0.5));
            sum += texelAt(i, j) * static_cast<float>(weight);
        }
    }
    return sum;
}

TEST(SampleTexture, AgreesWithTheEndlessPlaneOfTexelsInEveryWrapModeAndFilter) {
    constexpr TextureWrap kWraps[] = {TextureWrap::repeat, TextureWrap::mirroredRepeat,
                                      TextureWrap::clampToEdge};
    const Scene scene = makeTexturedTriangle(makeRandomImage(7, 5, 1));
    RandomStream random(2, 0);
    int checkCount = 0;
    for (const TextureWrap wrapU : kWraps) {
        for (const TextureWrap wrapV : kWraps) {
            for (const TextureFilter filter : {TextureFilter::linear, TextureFilter::nearest}) {
                const TextureUse texture{0, 0, wrapU, wrapV, filter};
                for (int i = 0; i < 200; ++i, ++checkCount) {
                    const Vec2f uv(6.0f * random.nextUnitFloat() - 3.0f,
                                   6.0f * random.nextUnitFloat() - 3.0f);
                    expectNear(sampleTexture(scene, texture, uv),
                               sampleSlowly(scene.images[0].pixels, texture, uv));
                }
            }
        }
    }
    EXPECT_EQ(checkCount, 3600);
}

TEST(SampleTexture, TheOriginIsTheTopLeftCornerAndTexelCentresLieAtOneHalf) {
    Rgba8Image image(2, 2);
    image.at(0, 0) = {255, 0, 0, 255};
    image.at(1, 0) = {0, 255, 0, 255};
    image.at(0, 1) = {0, 0, 255, 255};
    const Scene scene = makeTexturedTriangle(image);
    expectNear(sampleTexture(scene, {}, Vec2f(0.25f, 0.25f)), Vec4f(1.0f, 0.0f, 0.0f, 1.0f));
    expectNear(sampleTexture(scene, {}, Vec2f(0.75f, 0.25f)), Vec4f(0.0f, 1.0f, 0.0f, 1.0f));
    expectNear(sampleTexture(scene, {}, Vec2f(0.25f, 0.75f)), Vec4f(0.0f, 0.0f, 1.0f, 1.0f));
}

TEST(SampleTexture, BlendsLightNotCodeValuesAndAlphaLinearly) {
    Rgba8Image image(2, 1);
    image.at(0, 0) = {0, 0, 0, 0};
    image.at(1, 0) = {255, 188, 255, 128};
    const Scene scene = makeTexturedTriangle(image);
    const Vec4f between = sampleTexture(scene, {}, Vec2f(0.5f, 0.5f));
    // Half the linear light of sRGB white, and of code value 188,
    // which is 0.5028865 [IEC 61966-2-1].
    expectNear(between, Vec4f(0.5f, 0.5f * 0.5028865f, 0.5f, 0.5f * 128.0f / 255.0f));
}

TEST(SampleTexture, AnythingForACoordinateGivesAFiniteColour) {
    const Scene scene = makeTexturedTriangle(makeRandomImage(3, 2, 3));
    for (const TextureWrap wrap :
         {TextureWrap::repeat, TextureWrap::mirroredRepeat, TextureWrap::clampToEdge}) {
        for (const TextureFilter filter : {TextureFilter::linear, TextureFilter::nearest}) {
            for (const float u : {kNan, kInfinity, -kInfinity, 3e38f, -3e38f, 1e20f, -1e-30f, 1.0f,
                                  0.0f, 123456.7f}) {
                const Vec4f color =
                    sampleTexture(scene, {0, 0, wrap, wrap, filter}, Vec2f(u, 1.0f - u));
                for (int i = 0; i < 4; ++i)
                    EXPECT_TRUE(color[i] >= 0.0f && color[i] <= 1.0f) << u;
            }
        }
    }
}

TEST(SampleTexture, AnUndecodedTextureIsWhite) {
    const Scene scene = makeTexturedTriangle(Rgba8Image{});
    EXPECT_EQ(sampleTexture(scene, {}, Vec2f(0.3f, 0.4f)), Vec4f(1.0f));
}

TEST(BaseColor, IsTheProductOfFactorVertexColourAndTexture) {
    Scene scene = makeTexturedTriangle(makeRandomImage(4, 4, 4));
    scene.materials[0].baseColorFactor = Vec4f(0.9f, 0.8f, 0.7f, 0.6f);
    scene.meshes[0].colors = {Vec4f(1.0f), Vec4f(0.5f), Vec4f(0.0f, 0.25f, 1.0f, 0.5f)};
    const SurfacePoint point{0, 0, 0.2f, 0.3f};
    const Vec4f vertexColor =
        Vec4f(1.0f) * 0.5f + Vec4f(0.5f) * 0.2f + Vec4f(0.0f, 0.25f, 1.0f, 0.5f) * 0.3f;
    expectNear(evaluateBaseColor(scene, point),
               scene.materials[0].baseColorFactor * vertexColor *
                   sampleTexture(scene, TextureUse{}, Vec2f(0.2f, 0.3f)));
}

TEST(BaseColor, TakesTheSecondTriangleAndTheUvSetThatTheTextureNames) {
    Scene scene = makeTexturedTriangle(makeRandomImage(4, 4, 5));
    Mesh& mesh = scene.meshes[0];
    mesh.positions.emplace_back(1.0f, 1.0f, 0.0f);
    mesh.uvSets[0].emplace_back(1.0f, 1.0f);
    for (const Vec2f& uv : mesh.uvSets[0])
        mesh.uvSets[1].push_back(uv * 0.5f);
    mesh.indices = {0, 1, 2, 1, 3, 2};
    const SurfacePoint point{0, 1, 0.25f, 0.5f};
    const Vec2f uv =
        Vec2f(1.0f, 0.0f) * 0.25f + Vec2f(1.0f, 1.0f) * 0.25f + Vec2f(0.0f, 1.0f) * 0.5f;
    expectNear(evaluateBaseColor(scene, point), sampleTexture(scene, TextureUse{}, uv));
    scene.materials[0].baseColorTexture->uvSet = 1;
    expectNear(evaluateBaseColor(scene, point), sampleTexture(scene, TextureUse{}, uv * 0.5f));
}

TEST(BaseColor, IgnoresATextureWithoutItsUvs) {
    Scene scene = makeTexturedTriangle(makeRandomImage(4, 4, 6));
    scene.materials[0].baseColorTexture->uvSet = 1;
    EXPECT_EQ(evaluateBaseColor(scene, {}), Vec4f(1.0f));
}

TEST(BaseColor, IsAReflectanceWhateverTheFileSays) {
    Scene scene = makeTexturedTriangle(Rgba8Image{});
    scene.materials[0].baseColorFactor = Vec4f(7.0f, -1.0f, kNan, 0.5f);
    EXPECT_EQ(evaluateBaseColor(scene, {}), Vec4f(1.0f, 0.0f, 0.0f, 0.5f));
}

TEST(MetallicRoughness, IsFactorsTimesBlueAndGreenWithoutSrgb) {
    Rgba8Image image(2, 1);
    image.at(0, 0) = {255, 51, 204, 255};
    image.at(1, 0) = {0, 102, 0, 0};
    Scene scene = makeTexturedTriangle(image);
    Material& material = scene.materials[0];
    material.metallicRoughnessTexture = material.baseColorTexture;
    material.metallicFactor = 0.5f;
    material.roughnessFactor = 0.75f;
    const MetallicRoughness texel = evaluateMetallicRoughness(scene, {0, 0, 0.25f, 0.5f});
    EXPECT_NEAR(texel.metallic, 0.5f * 0.8f, kRounding);
    EXPECT_NEAR(texel.roughness, 0.75f * 0.2f, kRounding);
    const MetallicRoughness between = evaluateMetallicRoughness(scene, {0, 0, 0.5f, 0.25f});
    EXPECT_NEAR(between.metallic, 0.5f * 0.4f, kRounding);
    EXPECT_NEAR(between.roughness, 0.75f * 0.3f, kRounding);
}

TEST(MetallicRoughness, IsTheFactorsWithoutATextureAndWithinBoundsWhateverTheFileSays) {
    Scene scene = makeTexturedTriangle(Rgba8Image{});
    Material& material = scene.materials[0];
    material.metallicFactor = 0.25f;
    material.roughnessFactor = 0.125f;
    EXPECT_EQ(evaluateMetallicRoughness(scene, {}).metallic, 0.25f);
    EXPECT_EQ(evaluateMetallicRoughness(scene, {}).roughness, 0.125f);
    material.metallicRoughnessTexture = TextureUse{};
    material.metallicFactor = 7.0f;
    material.roughnessFactor = kNan;
    EXPECT_EQ(evaluateMetallicRoughness(scene, {}).metallic, 1.0f);
    EXPECT_EQ(evaluateMetallicRoughness(scene, {}).roughness, 0.0f);
}

TEST(BaseColor, OnlyTheMaskModeLetsLightThrough) {
    Material material;
    EXPECT_FALSE(isMasked(material));
    material.alphaMode = AlphaMode::blend;
    EXPECT_FALSE(isMasked(material));
    material.alphaMode = AlphaMode::mask;
    EXPECT_TRUE(isMasked(material));
}

}  // namespace
}  // namespace prt
