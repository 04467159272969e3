#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "prt/base/error.h"
#include "tests/gltf/gltf_builder.h"

namespace prt::test {
namespace {

/// What float arithmetic may leave between a fraction and its value.
constexpr float kTolerance = 1e-6f;

/// Reads the positions of the file's only primitive, which has no indices.
std::vector<Vec3f> readPositions(GltfBuilder builder, std::size_t accessor) {
    builder.addMeshNode({{"attributes", {{"POSITION", accessor}}}});
    return builder.read().meshes.at(0).positions;
}

void expectNear(const std::vector<Vec3f>& actual, const std::vector<Vec3f>& expected) {
    ASSERT_EQ(actual.size(), expected.size());
    for (std::size_t i = 0; i < actual.size(); ++i)
        EXPECT_LE((actual[i] - expected[i]).length(), kTolerance)
            << "vertex " << i << " is " << actual[i];
}

template <class T>
std::vector<std::byte> bytesOf(const std::vector<T>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    return {bytes.begin(), bytes.end()};
}

TEST(GltfAccessor, PackedFloatsAreReadAsTheyStand) {
    GltfBuilder builder;
    const auto accessor = builder.addVectors({0, 1, 2, 3, 4, 5, -6, 7.5f, 8});
    EXPECT_EQ(readPositions(builder, accessor),
              (std::vector<Vec3f>{{0, 1, 2}, {3, 4, 5}, {-6, 7.5f, 8}}));
}

TEST(GltfAccessor, AnOffsetIntoTheViewSkipsElements) {
    GltfBuilder builder;
    const std::vector<float> values = {9, 9, 9, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    const auto accessor = builder.add("accessors", {{"bufferView", builder.addView(values)},
                                                    {"byteOffset", 12},
                                                    {"componentType", 5126},
                                                    {"type", "VEC3"},
                                                    {"count", 3}});
    EXPECT_EQ(readPositions(builder, accessor),
              (std::vector<Vec3f>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
}

TEST(GltfAccessor, InterleavedAttributesAreTakenApart) {
    // Position, normal and UV of each vertex, one after the other: 32 bytes.
    GltfBuilder builder;
    std::vector<float> vertices;
    for (int i = 0; i < 3; ++i) {
        const float f = static_cast<float>(i);
        for (const float value : {f, f * f, 1.0f, 0.0f, 0.0f, 1.0f, f / 4, 1 - f / 4})
            vertices.push_back(value);
    }
    const auto view = builder.addView(vertices, 32);
    const auto slice = [&](int byteOffset, const char* type) {
        return builder.add("accessors", {{"bufferView", view},
                                         {"byteOffset", byteOffset},
                                         {"componentType", 5126},
                                         {"type", type},
                                         {"count", 3}});
    };
    const Json attributes = {{"POSITION", slice(0, "VEC3")},
                             {"NORMAL", slice(12, "VEC3")},
                             {"TEXCOORD_0", slice(24, "VEC2")}};
    builder.addMeshNode({{"attributes", attributes}});
    const Mesh mesh = builder.read().meshes.at(0);
    EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{{0, 0, 1}, {1, 1, 1}, {2, 4, 1}}));
    EXPECT_EQ(mesh.normals, (std::vector<Vec3f>(3, {0, 0, 1})));
    EXPECT_EQ(mesh.uvSets[0], (std::vector<Vec2f>{{0, 1}, {0.25f, 0.75f}, {0.5f, 0.5f}}));
}

TEST(GltfAccessor, TheLastInterleavedElementNeedsNoPaddingAfterIt) {
    GltfBuilder builder;
    const std::vector<float> values = {1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9};
    const auto accessor = builder.add("accessors", {{"bufferView", builder.addView(values, 16)},
                                                    {"componentType", 5126},
                                                    {"type", "VEC3"},
                                                    {"count", 3}});
    EXPECT_EQ(readPositions(builder, accessor),
              (std::vector<Vec3f>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
}

template <class Index>
Json sparseOf(GltfBuilder& builder, const std::vector<Index>& indices,
              const std::vector<float>& values) {
    return {
        {"count", indices.size()},
        {"indices",
         {{"bufferView", builder.addView(indices)}, {"componentType", componentTypeCode<Index>()}}},
        {"values", {{"bufferView", builder.addView(values)}}}};
}

TEST(GltfAccessor, SparseElementsReplaceThoseOfTheView) {
    GltfBuilder builder;
    const auto accessor = builder.addVectors({0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3});
    builder.json["accessors"][accessor]["sparse"] =
        sparseOf<std::uint8_t>(builder, {1, 3}, {10, 11, 12, 30, 31, 32});
    EXPECT_EQ(readPositions(builder, accessor),
              (std::vector<Vec3f>{{0, 0, 0}, {10, 11, 12}, {2, 2, 2}, {30, 31, 32}}));
}

TEST(GltfAccessor, SparseElementsWithoutAViewStandAmongZeros) {
    GltfBuilder builder;
    const Json sparse = sparseOf<std::uint16_t>(builder, {0, 2}, {1, 2, 3, 4, 5, 6});
    const auto accessor = builder.add(
        "accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 3}, {"sparse", sparse}});
    EXPECT_EQ(readPositions(builder, accessor),
              (std::vector<Vec3f>{{1, 2, 3}, {0, 0, 0}, {4, 5, 6}}));
}

TEST(GltfAccessor, SparseValuesArePackedEvenWhereTheViewIsNot) {
    GltfBuilder builder;
    const std::vector<float> values = {1, 1, 1, -1, 2, 2, 2, -1, 3, 3, 3, -1};
    const auto view = builder.addView(values, 16);
    const Json sparse = sparseOf<std::uint32_t>(builder, {1, 2}, {5, 5, 5, 6, 6, 6});
    const auto accessor = builder.add("accessors", {{"bufferView", view},
                                                    {"componentType", 5126},
                                                    {"type", "VEC3"},
                                                    {"count", 3},
                                                    {"sparse", sparse}});
    EXPECT_EQ(readPositions(builder, accessor),
              (std::vector<Vec3f>{{1, 1, 1}, {5, 5, 5}, {6, 6, 6}}));
}

template <class Index>
void expectSparseIndicesAreRefused(const std::vector<Index>& indices) {
    GltfBuilder builder;
    const auto accessor = builder.addVectors({0, 0, 0, 1, 1, 1, 2, 2, 2});
    builder.json["accessors"][accessor]["sparse"] =
        sparseOf<Index>(builder, indices, {9, 9, 9, 9, 9, 9});
    EXPECT_THROW(readPositions(builder, accessor), Error);
}

TEST(GltfAccessor, SparseIndicesMustAscendBelowTheCount) {
    expectSparseIndicesAreRefused<std::uint8_t>({1, 1});
    expectSparseIndicesAreRefused<std::uint8_t>({2, 0});
    expectSparseIndicesAreRefused<std::uint8_t>({0, 3});
    expectSparseIndicesAreRefused<std::uint32_t>({0, 0xffffffffu});
}

/// Four vertices of three components, each vertex padded to four.
template <class T>
GltfBuilder makeQuantizedFile(const std::vector<T>& padded, bool normalized) {
    GltfBuilder builder;
    builder.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    builder.add("accessors",
                {{"bufferView", builder.addView(padded, 4 * static_cast<int>(sizeof(T)))},
                 {"componentType", componentTypeCode<T>()},
                 {"type", "VEC3"},
                 {"normalized", normalized},
                 {"count", padded.size() / 4}});
    return builder;
}

TEST(GltfAccessor, QuantizedPositionsAreWholeNumbersOrFractions) {
    const std::vector<std::int8_t> bytes = {-128, 0, 127, 0, 64, -64, -127, 0, 1, 2, 3, 0};
    expectNear(readPositions(makeQuantizedFile(bytes, false), 0),
               {{-128, 0, 127}, {64, -64, -127}, {1, 2, 3}});
    // The most negative byte is −1 too, as the specification has it.
    expectNear(readPositions(makeQuantizedFile(bytes, true), 0),
               {{-1, 0, 1}, {64.0f / 127, -64.0f / 127, -1}, {1.0f / 127, 2.0f / 127, 3.0f / 127}});

    const std::vector<std::uint8_t> unsignedBytes = {0, 255, 51, 9, 1, 2, 3, 9, 4, 5, 6, 9};
    expectNear(
        readPositions(makeQuantizedFile(unsignedBytes, true), 0),
        {{0, 1, 0.2f}, {1 / 255.f, 2 / 255.f, 3 / 255.f}, {4 / 255.f, 5 / 255.f, 6 / 255.f}});

    const std::vector<std::int16_t> shorts = {-32768, 32767, 0, 0, 1, -1, 300, 0, 5, 6, 7, 0};
    expectNear(readPositions(makeQuantizedFile(shorts, false), 0),
               {{-32768, 32767, 0}, {1, -1, 300}, {5, 6, 7}});
    expectNear(readPositions(makeQuantizedFile(shorts, true), 0),
               {{-1, 1, 0},
                {1 / 32767.f, -1 / 32767.f, 300 / 32767.f},
                {5 / 32767.f, 6 / 32767.f, 7 / 32767.f}});

    const std::vector<std::uint16_t> unsignedShorts = {65535, 0, 13107, 0, 1, 2, 3, 0, 4, 5, 6, 0};
    expectNear(readPositions(makeQuantizedFile(unsignedShorts, true), 0),
               {{1, 0, 0.2f},
                {1 / 65535.f, 2 / 65535.f, 3 / 65535.f},
                {4 / 65535.f, 5 / 65535.f, 6 / 65535.f}});
}

TEST(GltfAccessor, QuantizedPositionsNeedTheirExtension) {
    GltfBuilder builder =
        makeQuantizedFile<std::int16_t>({1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0}, false);
    builder.json.erase("extensionsUsed");
    EXPECT_THROW(readPositions(builder, 0), Error);
}

TEST(GltfAccessor, AWholeNumberMayBeWrittenWithAPoint) {
    GltfBuilder builder = makeTriangleFile();
    builder.json["accessors"][0]["count"] = 3.0;
    EXPECT_EQ(builder.read().vertexCount(), 3u);
    builder.json["accessors"][0]["count"] = 2.5;
    EXPECT_THROW(builder.read(), Error);
}

template <class Index>
void expectIndicesAreRead() {
    GltfBuilder builder;
    const auto positions = builder.addVectors({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    const std::vector<Index> corners = {2, 0, 1, 1, 3, 2};
    const auto indices = builder.addArray(corners, "SCALAR", corners.size());
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    EXPECT_EQ(builder.read().meshes.at(0).indices, (std::vector<std::uint32_t>{2, 0, 1, 1, 3, 2}));
}

TEST(GltfAccessor, IndicesMayHaveOneTwoOrFourBytes) {
    expectIndicesAreRead<std::uint8_t>();
    expectIndicesAreRead<std::uint16_t>();
    expectIndicesAreRead<std::uint32_t>();
}

template <class Component>
std::vector<Vec4f> readColors(const std::vector<Component>& values, const char* type,
                              bool normalized) {
    GltfBuilder builder;
    const auto positions = builder.addVectors(kTriangle);
    const auto colors = builder.addArray(values, type, 3);
    builder.json["accessors"][colors]["normalized"] = normalized;
    builder.addMeshNode({{"attributes", {{"POSITION", positions}, {"COLOR_0", colors}}}});
    return builder.read().meshes.at(0).colors;
}

TEST(GltfAccessor, VertexColoursMayBeFloatsBytesOrShorts) {
    const std::vector<Vec4f> expected = {{1, 0, 0.2f, 1}, {0, 1, 0, 1}, {0.6f, 0.4f, 1, 1}};
    const std::vector<std::vector<Vec4f>> all = {
        readColors<float>({1, 0, 0.2f, 0, 1, 0, 0.6f, 0.4f, 1}, "VEC3", false),
        readColors<float>({1, 0, 0.2f, 1, 0, 1, 0, 1, 0.6f, 0.4f, 1, 1}, "VEC4", false),
        readColors<std::uint8_t>({255, 0, 51, 255, 0, 255, 0, 255, 153, 102, 255, 255}, "VEC4",
                                 true),
        readColors<std::uint16_t>(
            {65535, 0, 13107, 65535, 0, 65535, 0, 65535, 39321, 26214, 65535, 65535}, "VEC4",
            true)};
    for (const std::vector<Vec4f>& colors : all) {
        ASSERT_EQ(colors.size(), expected.size());
        for (std::size_t i = 0; i < colors.size(); ++i)
            for (int c = 0; c < 4; ++c)
                EXPECT_NEAR(colors[i][c], expected[i][c], kTolerance);
    }
}

TEST(GltfAccessor, AMatrixHasItsColumnsPaddedToFourBytes) {
    // MAT2 of bytes: columns (1, 2) and (3, 4), each but the file's last
    // followed by two bytes of padding.
    GltfBuilder builder = makeTriangleFile();
    const std::vector<std::uint8_t> padded = {1, 2, 0, 0, 3, 4, 0, 0, 5, 6, 0, 0, 7, 8};
    const auto matrices = builder.addArray(padded, "MAT2", 2);
    const ScratchFolder folder;
    const GltfDocument document(folder.write("scene.glb", builder.glb()));
    EXPECT_EQ(document.describeAccessor(matrices).componentCount, 4);
    EXPECT_EQ(document.readFloats(matrices), (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(document.readRaw(matrices),
              bytesOf(std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(GltfAccessor, RawComponentsAreThoseOfTheFile) {
    GltfBuilder builder;
    const std::vector<float> values = {1, 2, 3, -1, 4, 5, 6, -1, 7, 8, 9, -1};
    const auto accessor = builder.add("accessors", {{"bufferView", builder.addView(values, 16)},
                                                    {"componentType", 5126},
                                                    {"type", "VEC3"},
                                                    {"count", 3}});
    builder.addMeshNode({{"attributes", {{"POSITION", accessor}}}});
    const ScratchFolder folder;
    const GltfDocument document(folder.write("scene.glb", builder.glb()));
    EXPECT_EQ(document.readRaw(accessor), bytesOf(std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(GltfAccessor, FloatsThatAreNotFiniteAreRefused) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        GltfBuilder builder = makeTriangleFile();
        const auto accessor = builder.addVectors({0, bad, 0});
        const ScratchFolder folder;
        const GltfDocument document(folder.write("scene.glb", builder.glb()));
        EXPECT_THROW(document.readFloats(accessor), Error);
        EXPECT_EQ(document.readRaw(accessor), bytesOf(std::vector<float>{0, bad, 0}));
    }
}

}  // namespace
}  // namespace prt::test
