#include "prt/gltf/gltf_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "prt/base/error.h"
#include "prt/scene/normals.h"
#include "tests/gltf/gltf_builder.h"

namespace prt::test {
namespace {

/// What rounding a transformed unit-sized position or normal to float may cost.
constexpr float kTolerance = 1e-6f;

std::vector<std::uint32_t> readTriangles(int mode, std::size_t vertexCount) {
    GltfBuilder builder;
    std::vector<float> positions;
    for (std::size_t i = 0; i < 3 * vertexCount; ++i)
        positions.push_back(static_cast<float>(i * i % 7));
    builder.addMeshNode(
        {{"attributes", {{"POSITION", builder.addVectors(positions)}}}, {"mode", mode}});
    return builder.read().meshes.at(0).indices;
}

TEST(GltfTopology, StripsAndFansKeepTheSpecifiedWinding) {
    // [glTF 2.0, 3.7.2.1]: strip p_i = {v_i, v_(i+1+i%2), v_(i+2−i%2)}, fan p_i = {v_(i+1),
    // v_(i+2), v_0}.
    EXPECT_EQ(readTriangles(4, 6), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(readTriangles(5, 5), (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2, 2, 3, 4}));
    EXPECT_EQ(readTriangles(6, 5), (std::vector<std::uint32_t>{1, 2, 0, 2, 3, 0, 3, 4, 0}));
}

TEST(GltfTopology, AFlatStripFacesOneWay) {
    GltfBuilder builder;
    const auto positions = builder.addVectors({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}}, {"mode", 5}});
    const Mesh mesh = builder.read().meshes.at(0);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        EXPECT_EQ(
            triangleNormal(mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                           mesh.positions[mesh.indices[i + 2]]),
            Vec3f(0, 0, 1));
}

TEST(GltfTopology, WhatEndsWithinATriangleIsCutWithAWarning) {
    GltfBuilder builder;
    const auto positions = builder.addVectors({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}}});
    const Scene scene = builder.read();
    EXPECT_EQ(scene.meshes.at(0).indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(GltfTopology, PointsAndLinesAreLeftOutWithAWarning) {
    for (int mode = 0; mode < 4; ++mode) {
        GltfBuilder builder = makeTriangleFile();
        builder.addMeshNode({{"attributes", {{"POSITION", 0}}}, {"mode", mode}});
        const Scene scene = builder.read();
        EXPECT_EQ(scene.meshes.size(), 1u);
        EXPECT_EQ(scene.warnings.size(), 1u);
    }
}

TEST(GltfNodes, TransformsChainFromRootToLeaf) {
    // The leaf turns +x to +y about z, its parent doubles, the root moves.
    GltfBuilder builder = makeTriangleFile();
    const double half = std::numbers::sqrt2 / 2;
    builder.json["nodes"][0]["rotation"] = {0, 0, half, half};
    builder.add("nodes", {{"children", {0}}, {"scale", {2, 2, 2}}});
    builder.add("nodes", {{"children", {1}}, {"translation", {10, 20, 30}}});
    const std::vector<Vec3f> positions = builder.read().meshes.at(0).positions;
    const std::vector<Vec3f> expected = {{10, 20, 30}, {10, 22, 30}, {8, 20, 30}};
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_LE((positions[i] - expected[i]).length(), 100 * kTolerance);
}

TEST(GltfNodes, AMatrixIsColumnMajor) {
    // x ↦ y + 5, y ↦ 2z, z ↦ −x
    GltfBuilder builder = makeTriangleFile();
    builder.json["nodes"][0]["matrix"] = {0, 1, 0, 0, 0, 0, 2, 0, -1, 0, 0, 0, 5, 0, 0, 1};
    EXPECT_EQ(builder.read().meshes.at(0).positions,
              (std::vector<Vec3f>{{5, 0, 0}, {5, 1, 0}, {5, 0, 2}}));
}

TEST(GltfNodes, InstancesAreFlattenedIntoMeshesOfTheirOwn) {
    GltfBuilder builder = makeTriangleFile();
    builder.add("nodes", {{"mesh", 0}, {"translation", {0, 0, 7}}});
    const Scene scene = builder.read();
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.meshes[0].positions[1], Vec3f(1, 0, 0));
    EXPECT_EQ(scene.meshes[1].positions[1], Vec3f(1, 0, 7));
}

TEST(GltfNodes, OnlyTheDefaultSceneIsRead) {
    GltfBuilder builder = makeTriangleFile();
    builder.add("nodes", {{"mesh", 0}, {"translation", {0, 0, 7}}});
    builder.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    EXPECT_EQ(builder.read().meshes.size(), 2u) << "no scene is named: all roots";
    builder.json["scene"] = 1;
    const Scene scene = builder.read();
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].positions[1], Vec3f(1, 0, 7));
}

TEST(GltfNodes, MirroredInstancesStayCounterClockwise) {
    const std::vector<Json> scales = {
        {1, 1, 1}, {-1, 1, 1}, {2, -3, 0.5}, {-1, -1, -1}, {-1, 1, -1}};
    for (const Json& scale : scales) {
        const Mesh mesh = makeTetrahedronFile({{"scale", scale}}).read().meshes.at(0);
        const double product =
            scale[0].get<double>() * scale[1].get<double>() * scale[2].get<double>();
        EXPECT_NEAR(signedVolume(mesh), std::abs(product) / 6, 1e-6) << scale;
    }
}

TEST(GltfNodes, NormalsStayPerpendicularAndOutsideUnderAnyScale) {
    // A triangle in the plane x + y + z = 1 with its normal; sheared,
    // squeezed and mirrored by a matrix.
    const std::vector<Json> matrices = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                        {5, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.2, 0, 1, 2, 3, 1},
                                        {-2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                        {1, 0.5, 0, 0, -0.3, -2, 0.1, 0, 0, 0, 3, 0, 0, 0, 0, 1},
                                        {1e-9, 0, 0, 0, 0, -1e-9, 0, 0, 0, 0, 1e-9, 0, 0, 0, 0, 1}};
    for (const Json& matrix : matrices) {
        GltfBuilder builder;
        const auto positions = builder.addVectors({1, 0, 0, 0, 1, 0, 0, 0, 1});
        const float n = 1 / std::numbers::sqrt3_v<float>;
        const auto normals = builder.addVectors({n, n, n, n, n, n, n, n, n});
        builder.addMeshNode({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}},
                            {{"matrix", matrix}});
        const Mesh mesh = builder.read().meshes.at(0);
        const Vec3f expected =
            triangleNormal(mesh.positions[mesh.indices[0]], mesh.positions[mesh.indices[1]],
                           mesh.positions[mesh.indices[2]]);
        for (const Vec3f& normal : mesh.normals)
            EXPECT_LE((normal - expected).length(), 10 * kTolerance) << matrix;
    }
}

TEST(GltfNodes, FlatInstancesAreLeftOutWithAWarning) {
    GltfBuilder builder = makeTriangleFile();
    builder.add("nodes", {{"mesh", 0}, {"scale", {1, 0, 1}}});
    builder.add("nodes",
                {{"mesh", 0}, {"matrix", {1, 1, 0, 0, 2, 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
    const Scene scene = builder.read();
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.warnings.size(), 2u);
}

TEST(GltfNormals, MissingOnesAreComputed) {
    const Mesh mesh = makeTriangleFile().read().meshes.at(0);
    EXPECT_EQ(mesh.normals, (std::vector<Vec3f>(3, {0, 0, 1})));
}

TEST(GltfNormals, ThoseWithoutADirectionAreComputedWithAWarning) {
    GltfBuilder builder;
    const auto positions = builder.addVectors(kTriangle);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto normals = builder.addVectors({0, 0, 0, nan, 0, 0, 0, 3, 4});
    builder.addMeshNode({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    const Scene scene = builder.read();
    EXPECT_EQ(scene.meshes.at(0).normals,
              (std::vector<Vec3f>{{0, 0, 1}, {0, 0, 1}, {0, 0.6f, 0.8f}}));
    EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(GltfNormals, QuantizedOnesAreFractions) {
    GltfBuilder builder;
    builder.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    const auto positions = builder.addVectors(kTriangle);
    const std::vector<std::int8_t> padded = {0, 0, 127, 0, 0, -127, 0, 0, 0, 0, -128, 0};
    const auto normals = builder.add("accessors", {{"bufferView", builder.addView(padded, 4)},
                                                   {"componentType", 5120},
                                                   {"normalized", true},
                                                   {"type", "VEC3"},
                                                   {"count", 3}});
    builder.addMeshNode({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    EXPECT_EQ(builder.read().meshes.at(0).normals,
              (std::vector<Vec3f>{{0, 0, 1}, {0, -1, 0}, {0, 0, -1}}));
}

TEST(GltfCameras, StandWhereTheirNodePutsThem) {
    GltfBuilder builder = makeTriangleFile();
    builder.add("cameras", {{"type", "perspective"},
                            {"name", "front"},
                            {"perspective", {{"yfov", 0.6}, {"znear", 0.1}}}});
    builder.add("cameras",
                {{"type", "orthographic"},
                 {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}}}});
    // A quarter turn about +y takes −z to −x; scale does not matter.
    const double half = std::numbers::sqrt2 / 2;
    builder.add("nodes", {{"camera", 0},
                          {"translation", {1, 2, 3}},
                          {"rotation", {0, half, 0, half}},
                          {"scale", {3, 3, 3}}});
    builder.add("nodes", {{"camera", 1}});
    const Scene scene = builder.read();
    ASSERT_EQ(scene.cameras.size(), 1u);
    const Camera& camera = scene.cameras[0];
    EXPECT_EQ(camera.name, "front");
    EXPECT_EQ(camera.eye, Vec3f(1, 2, 3));
    EXPECT_LE((camera.forward - Vec3f(-1, 0, 0)).length(), kTolerance);
    EXPECT_LE((camera.up - Vec3f(0, 1, 0)).length(), kTolerance);
    EXPECT_FLOAT_EQ(camera.verticalFovRadians, 0.6f);
    EXPECT_EQ(scene.warnings.size(), 1u) << "the orthographic one";
}

TEST(GltfScene, AFileWithoutTrianglesIsRefused) {
    GltfBuilder empty;
    EXPECT_THROW(empty.read(), Error);
    GltfBuilder unused = makeTriangleFile();
    unused.json.erase("nodes");
    EXPECT_THROW(unused.read(), Error);
}

TEST(GltfScene, BuffersMayBeEmbeddedOrBeside) {
    const ScratchFolder folder;
    GltfBuilder builder = makeTetrahedronFile();
    const std::vector<Vec3f> expected = builder.read().meshes.at(0).positions;
    EXPECT_EQ(readGltf(folder.write("embedded.gltf", builder.gltf())).meshes.at(0).positions,
              expected);
    folder.write("parts/my data.bin", builder.bytes);
    builder.json["buffers"] = {
        {{"byteLength", builder.bytes.size()}, {"uri", "parts/my%20data.bin"}}};
    EXPECT_EQ(readGltf(folder.write("beside.gltf", builder.gltf())).meshes.at(0).positions,
              expected);
}

TEST(GltfScene, UnknownChunksAreIgnored) {
    const ScratchFolder folder;
    std::vector<std::byte> file = makeTetrahedronFile().glb();
    for (const int byte : std::vector<int>{4, 0, 0, 0, 'A', 'B', 'C', 'D', 1, 2, 3, 4})
        file.push_back(static_cast<std::byte>(byte));
    const std::uint32_t length = static_cast<std::uint32_t>(file.size());
    std::memcpy(file.data() + 8, &length, sizeof(length));
    EXPECT_EQ(readGltf(folder.write("scene.glb", file)).triangleCount(), 4u);
}

TEST(GltfScene, BytesAfterTheEndAreLeftOutWithAWarning) {
    std::vector<std::byte> file = makeTetrahedronFile().glb();
    file.insert(file.end(), 5, std::byte{'x'});
    const GltfDocument document(file, "");
    EXPECT_EQ(document.trailingByteCount(), 5u);
    const Scene scene = document.flatten().scene;
    EXPECT_EQ(scene.triangleCount(), 4u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("5 bytes after the end"), std::string::npos);
}

TEST(GltfScene, APlaceholderBufferIsMissedOnlyWhereItIsUsed) {
    GltfBuilder builder = makeTetrahedronFile();
    builder.json = builder.finished();
    const auto buffer = builder.add("buffers", {{"byteLength", 1024}});
    const auto view = builder.add("bufferViews", {{"buffer", buffer}, {"byteLength", 36}});
    builder.add("accessors",
                {{"bufferView", view}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 3}});
    EXPECT_EQ(builder.read().triangleCount(), 4u);
    builder.json["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", 2}}}};
    try {
        builder.read();
        FAIL() << "positions that are nowhere were read";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::malformed);
        EXPECT_STREQ(error.what(), "accessors[2] lies in a buffer without bytes");
    }
    builder.json["accessors"][2]["count"] = 4;
    EXPECT_THROW(builder.read(), Error) << "it has a length all the same";
}

TEST(GltfScene, AnAccessorOfAnUnknownTypeIsMissedOnlyWhereItIsUsed) {
    GltfBuilder builder = makeTetrahedronFile();
    const std::size_t odd = builder.addVectors(kTriangle);
    builder.json["accessors"][odd]["type"] = "QUATERNION";
    EXPECT_EQ(builder.read().triangleCount(), 4u);
    EXPECT_TRUE(GltfDocument(builder.glb(), "").readFloats(odd).empty());
    builder.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = odd;
    EXPECT_THROW(builder.read(), Error);
}

TEST(GltfScene, RequiredExtensionsMustBeUnderstood) {
    GltfBuilder builder = makeTriangleFile();
    builder.json["extensionsUsed"] = {"KHR_materials_unlit", "EXT_lights_ies"};
    builder.json["extensionsRequired"] = {"KHR_materials_unlit"};
    EXPECT_EQ(builder.read().warnings.size(), 1u);
    for (const char* name : {"KHR_draco_mesh_compression", "KHR_meshopt_compression",
                             "EXT_texture_webp", "EXT_lights_ies"}) {
        builder.json["extensionsRequired"] = {name};
        try {
            builder.read();
            ADD_FAILURE() << name << " was accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::unsupported);
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
            EXPECT_FALSE(error.hint().empty());
        }
    }
}

TEST(GltfScene, ErrorsNameTheFileAndThePlace) {
    GltfBuilder builder = makeTriangleFile();
    builder.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 3;
    const ScratchFolder folder;
    const std::filesystem::path path = folder.write("scene.glb", builder.glb());
    try {
        readGltf(path);
        FAIL() << "an accessor that is not there was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::malformed);
        EXPECT_EQ(error.where(), path.string());
        EXPECT_STREQ(
            error.what(),
            "meshes[0].primitives[0].attributes.POSITION is 3, but the file has 1 accessors");
    }
}

TEST(GltfScene, LimitsHoldForWhatInstancesAddUpTo) {
    GltfBuilder builder = makeTriangleFile();
    for (int i = 0; i < 9; ++i)
        builder.add("nodes", {{"mesh", 0}});
    EXPECT_EQ(
        builder.read({.maxVertexCount = 30, .maxIndexCount = 30, .maxMeshCount = 10}).vertexCount(),
        30u);
    for (const GltfLimits& limits :
         {GltfLimits{.maxVertexCount = 29}, GltfLimits{.maxIndexCount = 29},
          GltfLimits{.maxMeshCount = 9}, GltfLimits{.maxFileBytes = 100}}) {
        try {
            builder.read(limits);
            ADD_FAILURE() << "the limit was passed over";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::limitExceeded);
        }
    }
}

TEST(GltfScene, NodesMayNestAsDeepAsTheLimit) {
    const auto nested = [](int depth) {
        GltfBuilder builder = makeTriangleFile();
        for (int i = 1; i < depth; ++i)
            builder.add("nodes", {{"children", {i - 1}}});
        return builder;
    };
    EXPECT_EQ(nested(256).read().triangleCount(), 1u);
    EXPECT_THROW(nested(257).read(), Error);
    EXPECT_THROW(nested(100'000).read(), Error);
}

}  // namespace
}  // namespace prt::test
