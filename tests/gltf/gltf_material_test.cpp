#include <gtest/gtest.h>

#include <numbers>

#include "prt/base/error.h"
#include "prt/gltf/gltf_scene.h"
#include "tests/gltf/gltf_builder.h"

namespace prt::test {
namespace {

constexpr float kTolerance = 1e-6f;

/// The first bytes are all that tells an image's type here; nothing decodes it.
const std::vector<std::uint8_t> kPng = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n', 1, 2, 3, 4};
const std::vector<std::uint8_t> kJpeg = {0xFF, 0xD8, 0xFF, 0xE0, 9, 9, 9, 9};

/// A triangle with two UV sets and the given material; textures 0 and 1 are a PNG and a JPEG.
GltfBuilder makeTexturedFile(Json material) {
    GltfBuilder builder;
    const auto positions = builder.addVectors(kTriangle);
    const auto uv0 = builder.addArray(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", 3);
    const auto uv1 =
        builder.addArray(std::vector<float>{.5f, .5f, .25f, .5f, .5f, .75f}, "VEC2", 3);
    builder.add("images", {{"bufferView", builder.addView(kPng)}, {"mimeType", "image/png"}});
    builder.add("images", {{"bufferView", builder.addView(kJpeg)}, {"mimeType", "image/jpeg"}});
    builder.add("samplers", {{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}});
    builder.add("textures", {{"source", 0}, {"sampler", 0}});
    builder.add("textures", {{"source", 1}});
    builder.add("materials", std::move(material));
    const Json attributes = {{"POSITION", positions}, {"TEXCOORD_0", uv0}, {"TEXCOORD_1", uv1}};
    builder.addMeshNode({{"attributes", attributes}, {"material", 0}});
    return builder;
}

TEST(GltfMaterial, EveryMemberIsRead) {
    const Scene scene = makeTexturedFile({{"name", "leaf"},
                                          {"doubleSided", true},
                                          {"alphaMode", "MASK"},
                                          {"alphaCutoff", 0.25},
                                          {"emissiveFactor", {0.5, 0.25, 1}},
                                          {"pbrMetallicRoughness",
                                           {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                                            {"metallicFactor", 0.75},
                                            {"roughnessFactor", 0.125}}}})
                            .read();
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.name, "leaf");
    EXPECT_TRUE(material.doubleSided);
    EXPECT_EQ(material.alphaMode, AlphaMode::mask);
    EXPECT_EQ(material.alphaCutoff, 0.25f);
    EXPECT_EQ(material.emissiveFactor, Vec3f(0.5f, 0.25f, 1.0f));
    EXPECT_EQ(material.baseColorFactor, Vec4f(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(material.metallicFactor, 0.75f);
    EXPECT_EQ(material.roughnessFactor, 0.125f);
    EXPECT_FALSE(material.baseColorTexture);
    EXPECT_TRUE(scene.images.empty()) << "no material uses one";
}

TEST(GltfMaterial, DefaultsAreThoseOfGltf) {
    const Scene given = makeTexturedFile(Json::object()).read();
    const Scene absent = makeTriangleFile().read();
    for (const Material& material : {given.materials.at(0), absent.materials.at(0)}) {
        EXPECT_EQ(material.baseColorFactor, Vec4f(1, 1, 1, 1));
        EXPECT_EQ(material.metallicFactor, 1.0f);
        EXPECT_EQ(material.roughnessFactor, 1.0f);
        EXPECT_EQ(material.alphaMode, AlphaMode::opaque);
        EXPECT_EQ(material.alphaCutoff, 0.5f);
        EXPECT_FALSE(material.doubleSided);
    }
}

TEST(GltfMaterial, FactorsOutOfRangeAreClampedWithAWarning) {
    const Scene scene = makeTexturedFile({{"emissiveFactor", {0, 7, 0}},
                                          {"pbrMetallicRoughness",
                                           {{"baseColorFactor", {-1, 2, 0.5, 1}},
                                            {"metallicFactor", 3},
                                            {"roughnessFactor", -1e300}}}})
                            .read();
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.baseColorFactor, Vec4f(0, 1, 0.5f, 1));
    EXPECT_EQ(material.metallicFactor, 1.0f);
    EXPECT_EQ(material.roughnessFactor, 0.0f);
    EXPECT_EQ(material.emissiveFactor, Vec3f(0, 1, 0));
    EXPECT_EQ(scene.warnings.size(), 4u);
}

TEST(GltfMaterial, TexturesKeepTheirSamplerUvSetAndEncodedImage) {
    const Scene scene = makeTexturedFile({{"pbrMetallicRoughness",
                                           {{"baseColorTexture", {{"index", 1}, {"texCoord", 1}}}}},
                                          {"emissiveTexture", {{"index", 0}}}})
                            .read();
    const Material& material = scene.materials.at(0);
    ASSERT_TRUE(material.baseColorTexture && material.emissiveTexture);
    EXPECT_EQ(material.baseColorTexture->uvSet, 1);
    EXPECT_EQ(material.baseColorTexture->wrapU, TextureWrap::repeat);
    EXPECT_EQ(material.baseColorTexture->filter, TextureFilter::linear);
    EXPECT_EQ(material.emissiveTexture->uvSet, 0);
    EXPECT_EQ(material.emissiveTexture->wrapU, TextureWrap::clampToEdge);
    EXPECT_EQ(material.emissiveTexture->wrapV, TextureWrap::mirroredRepeat);
    EXPECT_EQ(material.emissiveTexture->filter, TextureFilter::nearest);
    const TextureImage& jpeg = scene.images.at(material.baseColorTexture->image);
    const TextureImage& png = scene.images.at(material.emissiveTexture->image);
    EXPECT_EQ(jpeg.mimeType, "image/jpeg");
    EXPECT_EQ(png.mimeType, "image/png");
    EXPECT_EQ(png.encoded.size(), kPng.size());
    EXPECT_TRUE(png.pixels.pixels.empty());
    EXPECT_EQ(scene.meshes.at(0).uvSets[1][1], Vec2f(0.25f, 0.5f));
}

TEST(GltfMaterial, ImagesMayBeEmbeddedOrBeside) {
    const ScratchFolder folder;
    const std::span<const std::byte> png = std::as_bytes(std::span(kPng));
    folder.write("wood.png", png);
    for (const std::string& uri :
         {std::string("wood.png"), "data:image/png;base64," + encodeBase64(png)}) {
        GltfBuilder builder =
            makeTexturedFile({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
        builder.json["images"][0] = {{"uri", uri}};
        const Scene scene = readGltf(folder.write("scene.glb", builder.glb()));
        ASSERT_EQ(scene.images.size(), 1u);
        EXPECT_TRUE(std::equal(png.begin(), png.end(), scene.images[0].encoded.begin(),
                               scene.images[0].encoded.end()));
    }
}

TEST(GltfMaterial, ImagesOfOtherFormatsAreRefusedOrLeftOut) {
    const Json material = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}};
    GltfBuilder unknown = makeTexturedFile(material);
    unknown.json["images"][0]["bufferView"] = 0;  // positions
    EXPECT_THROW(unknown.read(), Error);
    // EXT_texture_webp without a fallback names no image that we could read.
    GltfBuilder webp = makeTexturedFile(material);
    webp.json["textures"][0] = {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
    const Scene scene = webp.read();
    EXPECT_FALSE(scene.materials.at(0).baseColorTexture);
    EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(GltfMaterial, ATextureTransformIsAppliedToTheUvs) {
    // The specification's own example: the lower left quadrant of the image, rotated clockwise by
    // 90° [KHR_texture_transform].
    const Json transform = {
        {"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}};
    const Json texture = {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
    const Mesh mesh = makeTexturedFile({{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}})
                          .read()
                          .meshes.at(0);
    // (0, 0), (1, 0) and (0, 1) go to the quadrant's lower left, upper left and lower right.
    const std::vector<Vec2f> expected = {{0, 1}, {0, 0.5f}, {0.5f, 1}};
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_LE((mesh.uvSets[0][i] - expected[i]).length(), kTolerance);
}

TEST(GltfMaterial, TexturesThatMapUvsDifferentlyGetSetsOfTheirOwn) {
    const Json moved = {{"index", 0},
                        {"texCoord", 0},
                        {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}};
    const Scene scene = makeTexturedFile({{"pbrMetallicRoughness", {{"baseColorTexture", moved}}},
                                          {"emissiveTexture", {{"index", 1}, {"texCoord", 0}}}})
                            .read();
    const Material& material = scene.materials.at(0);
    const Mesh& mesh = scene.meshes.at(0);
    const auto uvOf = [&](const std::optional<TextureUse>& texture) {
        return mesh.uvSets[static_cast<std::size_t>(texture.value().uvSet)][1];
    };
    EXPECT_EQ(uvOf(material.baseColorTexture), Vec2f(1.5f, 0.0f));
    EXPECT_EQ(uvOf(material.emissiveTexture), Vec2f(1.0f, 0.0f));
}

TEST(GltfMaterial, AFourthUvSetTakesThePlaceOfTheSecond) {
    GltfBuilder builder = makeTexturedFile(
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 3}}}}}});
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_2"] = attributes["TEXCOORD_0"];
    attributes["TEXCOORD_3"] = attributes["TEXCOORD_1"];
    attributes.erase("TEXCOORD_1");
    const Scene scene = builder.read();
    const int set = scene.materials.at(0).baseColorTexture.value().uvSet;
    EXPECT_EQ(scene.meshes.at(0).uvSets[static_cast<std::size_t>(set)][2], Vec2f(0.5f, 0.75f));
}

TEST(GltfMaterial, TheMetallicRoughnessTextureKeepsItsImageAndUvSet) {
    const Scene scene =
        makeTexturedFile({{"pbrMetallicRoughness",
                           {{"metallicRoughnessTexture", {{"index", 0}, {"texCoord", 1}}}}}})
            .read();
    const Material& material = scene.materials.at(0);
    ASSERT_TRUE(material.metallicRoughnessTexture);
    EXPECT_FALSE(material.baseColorTexture);
    EXPECT_EQ(material.metallicRoughnessTexture->uvSet, 1);
    EXPECT_EQ(material.metallicRoughnessTexture->wrapU, TextureWrap::clampToEdge);
    const TextureImage& png = scene.images.at(material.metallicRoughnessTexture->image);
    EXPECT_EQ(png.encoded.size(), kPng.size());
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfMaterial, AThirdWayToTheUvsIsLeftOutWithAWarning) {
    const auto scaled = [](int index, double scale) {
        return Json{{"index", index},
                    {"extensions", {{"KHR_texture_transform", {{"scale", {scale, scale}}}}}}};
    };
    const auto read = [&](double roughnessScale) {
        return makeTexturedFile({{"pbrMetallicRoughness",
                                  {{"baseColorTexture", scaled(0, 2.0)},
                                   {"metallicRoughnessTexture", scaled(1, roughnessScale)}}},
                                 {"emissiveTexture", scaled(0, 3.0)}})
            .read();
    };
    const Scene shared = read(3.0);
    ASSERT_TRUE(shared.materials.at(0).metallicRoughnessTexture);
    EXPECT_EQ(shared.materials[0].metallicRoughnessTexture->uvSet,
              shared.materials[0].emissiveTexture->uvSet);
    EXPECT_TRUE(shared.warnings.empty());
    const Scene third = read(4.0);
    EXPECT_TRUE(third.materials.at(0).baseColorTexture && third.materials[0].emissiveTexture);
    EXPECT_FALSE(third.materials[0].metallicRoughnessTexture);
    ASSERT_EQ(third.warnings.size(), 1u);
    EXPECT_NE(third.warnings[0].find("metallicRoughnessTexture"), std::string::npos);
}

TEST(GltfMaterial, AMetallicRoughnessTextureThatIsNotThereIsRefused) {
    EXPECT_THROW(
        makeTexturedFile({{"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 2}}}}}})
            .read(),
        Error);
}

TEST(GltfMaterial, AMissingUvSetIsTakenForZeroWithAWarning) {
    GltfBuilder builder = makeTexturedFile(
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}});
    builder.json["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_1");
    const Scene scene = builder.read();
    EXPECT_EQ(scene.meshes.at(0).uvSets[1], (std::vector<Vec2f>(3, {0, 0})));
    EXPECT_EQ(scene.warnings.size(), 1u);
}

}  // namespace
}  // namespace prt::test
