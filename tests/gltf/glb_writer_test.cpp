#include "prt/gltf/glb_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "prt/base/checksum.h"
#include "prt/base/error.h"
#include "prt/gltf/gltf_document.h"
#include "prt/gltf/gltf_scene.h"
#include "tests/gltf/glb_file.h"
#include "tests/gltf/gltf_builder.h"
#include "tests/support/kept_assets.h"

namespace prt {
namespace {

using test::GlbFile;
using test::ScratchFolder;
using test::splitGlb;

// Poses go through a matrix of unit columns: a few roundings of a float.
constexpr float kPoseTolerance = 1e-6f;

// A PNG of one orange pixel; 69 bytes, which is no multiple of four.
constexpr std::array<unsigned char, 69> kOnePixelPng = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
    0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00,
    0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00, 0x0c, 0x49, 0x44, 0x41, 0x54, 0x78,
    0xda, 0x63, 0xf8, 0xdf, 0xc0, 0x00, 0x00, 0x04, 0x01, 0x01, 0x80, 0xfb, 0xd7, 0xcb,
    0xf1, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

TextureImage onePixelImage(const std::string& name) {
    TextureImage image;
    image.name = name;
    image.mimeType = "image/png";
    const auto bytes = std::as_bytes(std::span(kOnePixelPng));
    image.encoded.assign(bytes.begin(), bytes.end());
    return image;
}

/// One triangle in the plane z = depth; an odd number of short indices, which need padding.
Mesh triangle(const std::string& name, float depth) {
    Mesh mesh;
    mesh.name = name;
    mesh.positions = {{0.1f, 0.2f, depth}, {1.3f, 0.2f, depth}, {0.1f, 1.7f, depth}};
    mesh.normals.assign(3, Vec3f(0.0f, 0.0f, 1.0f));
    mesh.indices = {0, 1, 2};
    return mesh;
}

Scene plainScene() {
    Scene scene;
    scene.materials.resize(1);
    scene.meshes = {triangle("", 0.0f)};
    return scene;
}

/// A scene with something of everything that a scene can hold.
Scene richScene() {
    Scene scene;
    scene.images = {onePixelImage("orange"), onePixelImage("")};

    Material painted;
    painted.name = "painted";
    painted.baseColorFactor = Vec4f(0.25f, 0.5f, 0.75f, 0.875f);
    painted.baseColorTexture = TextureUse{0, 0, TextureWrap::clampToEdge,
                                          TextureWrap::mirroredRepeat, TextureFilter::nearest};
    painted.emissiveFactor = Vec3f(0.5f, 0.25f, 0.125f);
    painted.emissiveTexture = TextureUse{1, 1};
    painted.metallicRoughnessTexture = TextureUse{1, 0, TextureWrap::mirroredRepeat};
    painted.metallicFactor = 0.5f;
    painted.roughnessFactor = 0.25f;
    painted.alphaMode = AlphaMode::mask;
    painted.alphaCutoff = 0.75f;
    painted.doubleSided = true;
    Material glass;
    glass.alphaMode = AlphaMode::blend;
    scene.materials = {painted, glass};

    scene.meshes = {triangle("near", 1.0f), triangle("far", -2.0f)};
    Mesh& mesh = scene.meshes[0];
    mesh.uvSets[0] = {{0.0f, 0.25f}, {-3.5f, 1.0f}, {0.5f, 0.75f}};
    mesh.uvSets[1] = {{0.5f, 0.5f}, {0.0f, 1.0f}, {1.0f, 0.0f}};
    mesh.colors = {{1.0f, 0.5f, 0.25f, 1.0f}, {0.0f, 0.125f, 1.0f, 0.5f}, {1, 1, 1, 1}};
    scene.meshes[1].material = 1;

    Camera tilted;
    tilted.name = "tilted";
    tilted.eye = Vec3f(1.5f, -2.0f, 3.25f);
    tilted.forward = Vec3f(0.6f, 0.0f, -0.8f);
    tilted.up = Vec3f(0.0f, 1.0f, 0.0f);
    tilted.verticalFovRadians = 0.5f;
    scene.cameras = {tilted, Camera{}};
    return scene;
}

Scene writeAndRead(const Scene& scene) {
    const ScratchFolder folder;
    writeGlb(folder.path() / "scene.glb", scene);
    test::keepAsset(folder.path() / "scene.glb");
    return readGltf(folder.path() / "scene.glb");
}

void expectSameTexture(const std::optional<TextureUse>& a, const std::optional<TextureUse>& b) {
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) return;
    EXPECT_EQ(a->image, b->image);
    EXPECT_EQ(a->uvSet, b->uvSet);
    EXPECT_EQ(a->wrapU, b->wrapU);
    EXPECT_EQ(a->wrapV, b->wrapV);
    EXPECT_EQ(a->filter, b->filter);
}

void expectSameMaterial(const Material& a, const Material& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.baseColorFactor, b.baseColorFactor);
    EXPECT_EQ(a.emissiveFactor, b.emissiveFactor);
    EXPECT_EQ(a.metallicFactor, b.metallicFactor);
    EXPECT_EQ(a.roughnessFactor, b.roughnessFactor);
    EXPECT_EQ(a.alphaMode, b.alphaMode);
    EXPECT_EQ(a.alphaCutoff, b.alphaCutoff);
    EXPECT_EQ(a.doubleSided, b.doubleSided);
    expectSameTexture(a.baseColorTexture, b.baseColorTexture);
    expectSameTexture(a.emissiveTexture, b.emissiveTexture);
    expectSameTexture(a.metallicRoughnessTexture, b.metallicRoughnessTexture);
}

void expectSameMesh(const Mesh& a, const Mesh& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.material, b.material);
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.uvSets, b.uvSets);
    EXPECT_EQ(a.colors, b.colors);
    EXPECT_EQ(a.indices, b.indices);
}

ErrorCode codeOfEncoding(const Scene& scene) {
    try {
        encodeGlb(scene);
    } catch (const Error& error) {
        return error.code();
    }
    ADD_FAILURE() << "the scene was accepted";
    return ErrorCode::cancelled;
}

TEST(GlbWriter, AllThatASceneHoldsComesBack) {
    const Scene written = richScene();
    const Scene read = writeAndRead(written);
    EXPECT_TRUE(read.warnings.empty());

    ASSERT_EQ(read.meshes.size(), written.meshes.size());
    for (std::size_t i = 0; i < written.meshes.size(); ++i)
        expectSameMesh(read.meshes[i], written.meshes[i]);
    ASSERT_EQ(read.materials.size(), written.materials.size());
    for (std::size_t i = 0; i < written.materials.size(); ++i)
        expectSameMaterial(read.materials[i], written.materials[i]);
    ASSERT_EQ(read.images.size(), written.images.size());
    for (std::size_t i = 0; i < written.images.size(); ++i) {
        EXPECT_EQ(read.images[i].name, written.images[i].name);
        EXPECT_EQ(read.images[i].mimeType, written.images[i].mimeType);
        EXPECT_EQ(read.images[i].encoded, written.images[i].encoded);
    }
    ASSERT_EQ(read.cameras.size(), written.cameras.size());
    for (std::size_t i = 0; i < written.cameras.size(); ++i) {
        EXPECT_EQ(read.cameras[i].name, written.cameras[i].name);
        EXPECT_EQ(read.cameras[i].eye, written.cameras[i].eye);
        EXPECT_LT((read.cameras[i].forward - written.cameras[i].forward).length(), kPoseTolerance);
        EXPECT_LT((read.cameras[i].up - written.cameras[i].up).length(), kPoseTolerance);
        EXPECT_EQ(read.cameras[i].verticalFovRadians, written.cameras[i].verticalFovRadians);
    }
}

TEST(GlbWriter, IndicesAreLongOnlyWhereShortOnesCannotCount) {
    // 65535 vertices have indices to 65534; the next is the short restart index.
    for (const std::size_t vertexCount : {std::size_t(65535), std::size_t(65536)}) {
        Scene scene = plainScene();
        Mesh& mesh = scene.meshes[0];
        for (std::size_t i = 3; i < vertexCount; ++i)
            mesh.positions.push_back(Vec3f(static_cast<float>(i), 1.0f, 0.0f));
        mesh.normals.assign(vertexCount, Vec3f(0.0f, 0.0f, 1.0f));
        mesh.indices = {0, 1, static_cast<std::uint32_t>(vertexCount - 1)};
        const GlbFile file = splitGlb(encodeGlb(scene));
        const auto& primitive = file.json["meshes"][0]["primitives"][0];
        const std::size_t indices = primitive["indices"];
        EXPECT_EQ(file.json["accessors"][indices]["componentType"],
                  vertexCount == 65535 ? 5123 : 5125);
        EXPECT_EQ(writeAndRead(scene).meshes[0].indices, mesh.indices);
    }
}

TEST(GlbWriter, EveryByteOfTheBufferLiesInOneView) {
    GlbFile file = splitGlb(encodeGlb(richScene()));
    std::size_t end = 0;
    for (const auto& view : file.json["bufferViews"]) {
        EXPECT_EQ(view["byteOffset"], end);
        end += view["byteLength"].get<std::size_t>();
    }
    EXPECT_EQ(file.json["buffers"][0]["byteLength"], end);
    // Only the chunk's own padding stands after the buffer, and it is zero.
    EXPECT_LT(file.binary.size() - end, 4u);
    EXPECT_EQ(file.binary.size() % 4, 0u);
    for (std::size_t i = end; i < file.binary.size(); ++i)
        EXPECT_EQ(file.binary[i], std::byte{0});
}

TEST(GlbWriter, EqualTexturesAndSamplersAreSharedAndEmptyListsAreLeftOut) {
    Scene scene = richScene();
    scene.materials[0].emissiveTexture = scene.materials[0].baseColorTexture;
    scene.materials[0].metallicRoughnessTexture = scene.materials[0].baseColorTexture;
    const GlbFile rich = splitGlb(encodeGlb(scene));
    EXPECT_EQ(rich.json["textures"].size(), 1u);
    EXPECT_EQ(rich.json["samplers"].size(), 1u);

    const GlbFile plain = splitGlb(encodeGlb(plainScene()));
    for (const char* key : {"textures", "samplers", "images", "cameras", "extensionsUsed",
                            "extensionsRequired", "extensions"})
        EXPECT_FALSE(plain.json.contains(key)) << key;
    EXPECT_FALSE(plain.json["meshes"][0].contains("name"));

    const GlbFile empty = splitGlb(encodeGlb(Scene{}));
    EXPECT_FALSE(empty.json.contains("buffers"));
    EXPECT_TRUE(empty.binary.empty());
}

TEST(GlbWriter, MeshesWithoutTrianglesAreLeftOut) {
    Scene scene = plainScene();
    scene.meshes.insert(scene.meshes.begin(), Mesh{});
    scene.meshes[0].positions.assign(1, Vec3f(0.0f));
    scene.meshes[0].normals.assign(1, Vec3f(0.0f, 1.0f, 0.0f));
    const Scene read = writeAndRead(scene);
    ASSERT_EQ(read.meshes.size(), 1u);
    expectSameMesh(read.meshes[0], scene.meshes[1]);
}

TEST(GlbWriter, ATextureWithoutUvsIsLeftOutForThatMeshAlone) {
    Scene scene = richScene();
    scene.meshes[1].material = 0;
    const Scene read = writeAndRead(scene);
    EXPECT_TRUE(read.materials[read.meshes[0].material].baseColorTexture);
    const Material& material = read.materials[read.meshes[1].material];
    EXPECT_FALSE(material.baseColorTexture || material.emissiveTexture ||
                 material.metallicRoughnessTexture);
    EXPECT_EQ(material.baseColorFactor, scene.materials[0].baseColorFactor);
}

TEST(GlbWriter, TheSecondUvSetStaysTheSecond) {
    Scene scene = richScene();
    scene.meshes[0].uvSets[0].clear();
    const Scene read = writeAndRead(scene);
    EXPECT_EQ(read.meshes[0].uvSets[1], scene.meshes[0].uvSets[1]);
}

TEST(GlbWriter, FactorsBeyondWhatGltfAllowsAreClampedAndEmissionKeepsItsStrength) {
    Scene scene = plainScene();
    scene.meshes[0].colors.assign(3, Vec4f(2.0f, -1.0f, 0.5f, 1.0f));
    scene.materials[0].baseColorFactor = Vec4f(1.5f, -0.25f, 0.5f, 1.0f);
    scene.materials[0].emissiveFactor = Vec3f(8.0f, 4.0f, 0.0f);
    const GlbFile file = splitGlb(encodeGlb(scene));
    const auto& material = file.json["materials"][0];
    EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorFactor"],
              (std::vector<double>{1.0, 0.0, 0.5, 1.0}));
    EXPECT_EQ(material["emissiveFactor"], (std::vector<double>{1.0, 0.5, 0.0}));
    EXPECT_EQ(material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"], 8.0);
    EXPECT_EQ(writeAndRead(scene).meshes[0].colors[0], Vec4f(1.0f, 0.0f, 0.5f, 1.0f));
}

TEST(GlbWriter, UnlitMaterialsSaySoAndDemandNothingOfReaders) {
    Scene scene = plainScene();
    scene.materials.resize(2);
    scene.meshes[0].colors.assign(3, Vec4f(0.25f, 0.5f, 0.75f, 1.0f));
    const GlbFile file = splitGlb(encodeGlb(scene, nullptr, {.unlit = true}));
    EXPECT_EQ(file.json["extensionsUsed"], std::vector<std::string>{"KHR_materials_unlit"});
    EXPECT_FALSE(file.json.contains("extensionsRequired"));
    ASSERT_EQ(file.json["materials"].size(), 2u);
    for (const auto& material : file.json["materials"])
        EXPECT_EQ(material.at("extensions").at("KHR_materials_unlit"), nlohmann::json::object());
    EXPECT_TRUE(file.json["meshes"][0]["primitives"][0]["attributes"].contains("COLOR_0"));
    EXPECT_FALSE(splitGlb(encodeGlb(scene)).json.contains("extensionsUsed"));
}

TEST(GlbWriter, NamesThatAreNotUtf8AreMended) {
    Scene scene = plainScene();
    scene.meshes[0].name = "caf\xe9";
    EXPECT_EQ(writeAndRead(scene).meshes[0].name, "caf\xef\xbf\xbd");
}

TEST(GlbWriter, NumbersThatAreNotFiniteAreRefused) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    std::vector<Scene> scenes(8, richScene());
    scenes[0].meshes[1].positions[2].y = nan;
    scenes[1].meshes[0].normals[1].x = infinity;
    scenes[2].meshes[0].uvSets[1][0].x = nan;
    scenes[3].meshes[0].colors[2].z = nan;
    scenes[4].materials[1].roughnessFactor = nan;
    scenes[5].materials[0].emissiveFactor.y = nan;
    scenes[6].cameras[0].eye.z = infinity;
    scenes[7].cameras[1].verticalFovRadians = nan;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        SCOPED_TRACE(i);
        EXPECT_EQ(codeOfEncoding(scenes[i]), ErrorCode::malformed);
    }
}

TEST(GlbWriter, AnImageWithoutBytesIsRefused) {
    Scene scene = richScene();
    scene.images[0].encoded.clear();
    EXPECT_EQ(codeOfEncoding(scene), ErrorCode::unsupported);
}

GlbExtension plainExtension(std::size_t vertexCount) {
    GlbExtension extension;
    extension.name = "TEST_extension";
    extension.rootJson = R"({"answer":42})";
    extension.meshJson = {R"({"question":7})"};
    const auto write = [](std::span<std::byte> values) {
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = static_cast<std::byte>(i);
    };
    extension.attributes = {{{"_TEST_0", {vertexCount, 4, ComponentType::uint8, true}, write}}};
    return extension;
}

TEST(GlbWriter, AnExtensionGetsItsAttributesAndTheChecksumOfEachView) {
    const GlbExtension extension = plainExtension(3);
    const std::vector<std::byte> bytes = encodeGlb(plainScene(), &extension);
    GlbFile file = splitGlb(bytes);
    EXPECT_EQ(file.json["extensionsUsed"], std::vector<std::string>{"TEST_extension"});
    EXPECT_FALSE(file.json.contains("extensionsRequired"));
    const auto& object = file.json["extensions"]["TEST_extension"];
    EXPECT_EQ(object["answer"], 42);
    ASSERT_EQ(object["checksums"].size(), file.json["bufferViews"].size());
    for (std::size_t view = 0; view < object["checksums"].size(); ++view)
        EXPECT_EQ(object["checksums"][view], formatChecksum(computeCrc32(file.view(view))));

    const auto& primitive = file.json["meshes"][0]["primitives"][0];
    const auto& meshObject = primitive["extensions"]["TEST_extension"];
    EXPECT_EQ(meshObject["question"], 7);
    EXPECT_EQ(meshObject["checksums"].size(), 3u);
    for (const char* semantic : {"POSITION", "NORMAL", "_TEST_0"}) {
        const std::size_t accessor = primitive["attributes"][semantic];
        EXPECT_EQ(meshObject["checksums"][semantic],
                  formatChecksum(computeCrc32(file.view(accessor))));
    }

    const ScratchFolder folder;
    const GltfDocument document(folder.write("extended.glb", bytes));
    const auto accessor = document.attributeAccessor({0, 0}, "_TEST_0");
    ASSERT_TRUE(accessor);
    std::vector<std::byte> expected(12);
    extension.attributes[0][0].write(expected);
    EXPECT_EQ(document.readRaw(*accessor), expected);
}

TEST(GlbWriter, AnExtensionsOwnAccessorsAreTheFirstOfTheFile) {
    // Lengths that need padding, and elements that no vertex attribute may have.
    const std::vector<GlbAccessor> accessors = {
        {"five bytes",
         {5, 1, ComponentType::uint8, true},
         [](std::span<std::byte> values) { std::ranges::fill(values, std::byte{7}); }},
        {"three shorts", {3, 1, ComponentType::uint16}, [](std::span<std::byte> values) {
             std::ranges::fill(values, std::byte{9});
         }}};
    Scene scene = richScene();
    const GltfDocument plain(encodeGlb(scene), "");
    GlbExtension extension = plainExtension(3);
    extension.meshJson.assign(2, "{}");
    extension.attributes.resize(2);
    extension.accessors = accessors;
    const GltfDocument document(encodeGlb(scene, &extension), "");
    ASSERT_EQ(document.accessorCount(), plain.accessorCount() + 3);
    EXPECT_EQ(document.bufferViewCount(), plain.bufferViewCount() + 3);
    for (std::size_t i = 0; i < accessors.size(); ++i) {
        const AccessorInfo info = document.describeAccessor(i);
        EXPECT_EQ(info.count, accessors[i].info.count);
        EXPECT_EQ(info.componentCount, 1);
        EXPECT_EQ(info.type, accessors[i].info.type);
        EXPECT_EQ(info.normalized, accessors[i].info.normalized);
    }
    EXPECT_EQ(document.readRaw(0), std::vector<std::byte>(5, std::byte{7}));
    EXPECT_EQ(document.readRaw(1), std::vector<std::byte>(6, std::byte{9}));
    const Scene read = document.flatten().scene;
    ASSERT_EQ(read.meshes.size(), 2u);
    expectSameMesh(read.meshes[0], scene.meshes[0]);
    ASSERT_EQ(read.images.size(), 2u);
    EXPECT_EQ(read.images[1].encoded, scene.images[1].encoded);
}

TEST(GlbWriter, ChecksumsAreEightLowerCaseDigits) {
    EXPECT_EQ(formatChecksum(0x00c0ffeeu), "00c0ffee");
    EXPECT_EQ(formatChecksum(0xffffffffu), "ffffffff");
    // The check value of CRC-32: of the nine digits [ISO 3309].
    const std::string digits = "123456789";
    EXPECT_EQ(formatChecksum(computeCrc32(std::as_bytes(std::span(digits)))), "cbf43926");
}

TEST(GlbWriter, MoreThanFourGibibytesAreRefusedBeforeTheyAreAllocated) {
    constexpr std::size_t kVertexCount = 1'000'000;
    constexpr std::size_t kAttributeCount = 300;  // of 16 bytes: 4.8 GB
    Scene scene = plainScene();
    scene.meshes[0].positions.assign(kVertexCount, Vec3f(0.0f));
    scene.meshes[0].normals.assign(kVertexCount, Vec3f(0.0f, 1.0f, 0.0f));
    GlbExtension extension = plainExtension(kVertexCount);
    GlbAccessor attribute = extension.attributes[0][0];
    attribute.info.type = ComponentType::float32;
    attribute.write = [](std::span<std::byte>) { ADD_FAILURE() << "nothing is to be written"; };
    extension.attributes[0].assign(kAttributeCount, attribute);
    try {
        encodeGlb(scene, &extension);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::limitExceeded);
        EXPECT_FALSE(error.hint().empty());
    }
}

}  // namespace
}  // namespace prt
