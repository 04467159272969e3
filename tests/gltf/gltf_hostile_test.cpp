#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "prt/base/error.h"
#include "prt/gltf/gltf_scene.h"
#include "tests/gltf/full_file.h"
#include "tests/gltf/gltf_builder.h"
#include "tests/gltf/safe_reading.h"

namespace prt::test {
namespace {

void expectRefused(const GltfBuilder& builder, const std::string& why) {
    EXPECT_FALSE(isRead(builder)) << why;
}

TEST(GltfHostile, TheFullFileIsWhole) {
    EXPECT_TRUE(isRead(makeFullFile()));
    EXPECT_TRUE(isRead(makeFullFile().gltf()));
}

TEST(GltfHostile, NoPrefixOfABinaryFileIsRead) {
    const std::vector<std::byte> whole = makeFullFile().glb();
    for (std::size_t length = 0; length < whole.size(); ++length)
        ASSERT_FALSE(isRead(std::span(whole).first(length))) << length;
}

TEST(GltfHostile, NoPrefixOfATextFileIsRead) {
    const std::string whole = makeFullFile().gltf();
    for (std::size_t length = 0; length < whole.size(); ++length)
        ASSERT_FALSE(isRead(whole.substr(0, length))) << length;
}

/// Changes every byte in four ways and demands that the result is refused or keeps every promise.
void expectEveryByteChangeIsSafe(std::vector<std::byte> file) {
    std::size_t readCount = 0;
    for (std::size_t i = 0; i < file.size(); ++i) {
        const unsigned original = std::to_integer<unsigned>(file[i]);
        for (const unsigned changed : {original + 1, original - 1, 0u, 0xffu}) {
            file[i] = static_cast<std::byte>(changed & 0xff);
            readCount += isRead(std::span<const std::byte>(file));
            ASSERT_FALSE(::testing::Test::HasFailure()) << "byte " << i << " made " << changed;
        }
        file[i] = static_cast<std::byte>(original);
    }
    EXPECT_GT(readCount, 0u) << "some changes, as of a colour, leave a readable file";
}

TEST(GltfHostile, EveryByteChangeOfABinaryFileIsSafe) {
    expectEveryByteChangeIsSafe(makeFullFile().glb());
}

TEST(GltfHostile, EveryByteChangeOfATextFileIsSafe) {
    const std::string text = makeFullFile().gltf();
    const auto bytes = std::as_bytes(std::span(text));
    expectEveryByteChangeIsSafe({bytes.begin(), bytes.end()});
}

/// Calls `visit` with a copy of the file for each member and element of
/// its JSON, and the pointer to it.
template <class Visit>
void forEachValue(const GltfBuilder& whole, Visit visit) {
    const Json flat = whole.json.flatten();
    for (const auto& [pointer, value] : flat.items()) {
        for (Json::json_pointer place(pointer); !place.empty(); place.pop_back()) {
            GltfBuilder changed = whole;
            visit(changed, place);
        }
    }
}

TEST(GltfHostile, EveryValueMayBeOfAnyTypeAndSize) {
    const std::vector<std::string> values = {"null",
                                             "true",
                                             "-1",
                                             "0.5",
                                             "2147483648",
                                             "4294967295",
                                             "9007199254740992",
                                             "9007199254740993",
                                             "18446744073709551615",
                                             "1e300",
                                             "-1e300",
                                             "1e-300",
                                             "\"0\"",
                                             "[]",
                                             "{}",
                                             "[0]",
                                             "[[[]]]",
                                             "{\"index\":0}"};
    forEachValue(makeFullFile(), [&](const GltfBuilder& whole, const Json::json_pointer& place) {
        for (const std::string& value : values) {
            GltfBuilder changed = whole;
            changed.json[place] = Json::parse(value);
            isRead(changed);
            ASSERT_FALSE(::testing::Test::HasFailure()) << place << " made " << value;
        }
    });
}

TEST(GltfHostile, EveryValueMayBeMissing) {
    forEachValue(makeFullFile(), [&](GltfBuilder& changed, const Json::json_pointer& place) {
        Json& parent = changed.json[place.parent_pointer()];
        if (parent.is_array())
            parent.erase(std::stoul(place.back()));
        else
            parent.erase(place.back());
        isRead(changed);
        ASSERT_FALSE(::testing::Test::HasFailure()) << place << " left out";
    });
}

TEST(GltfHostile, WhatMustBeAWholeNumberIsNothingElse) {
    const std::vector<const char*> places = {
        "/buffers/0/byteLength",
        "/bufferViews/0/buffer",
        "/bufferViews/0/byteOffset",
        "/bufferViews/0/byteLength",
        "/bufferViews/0/byteStride",
        "/accessors/0/bufferView",
        "/accessors/0/byteOffset",
        "/accessors/0/componentType",
        "/accessors/0/count",
        "/accessors/0/sparse/count",
        "/accessors/0/sparse/indices/bufferView",
        "/accessors/0/sparse/values/bufferView",
        "/meshes/0/primitives/0/indices",
        "/meshes/0/primitives/0/material",
        "/meshes/0/primitives/0/mode",
        "/meshes/0/primitives/0/attributes/POSITION",
        "/nodes/0/mesh",
        "/nodes/1/camera",
        "/nodes/1/children/0",
        "/scenes/0/nodes/0",
        "/scene",
        "/textures/0/source",
        "/textures/0/sampler",
        "/materials/0/pbrMetallicRoughness/baseColorTexture/index"};
    for (const char* place : places) {
        for (const char* value :
             {"\"0\"", "0.5", "-1", "2147483648", "9007199254740993", "null", "[0]"}) {
            GltfBuilder builder = makeFullFile();
            builder.json = builder.finished();
            builder.json[Json::json_pointer(place)] = Json::parse(value);
            expectRefused(builder, std::string(place) + " made " + value);
        }
    }
}

TEST(GltfHostile, OffsetsAndLengthsThatWrapAroundAreRefused) {  // F6
    const std::uint64_t huge = std::uint64_t(1) << 53;
    for (const std::uint64_t number : {huge, huge - 4, huge / 2, std::uint64_t(1) << 32}) {
        for (const char* place :
             {"/bufferViews/0/byteOffset", "/bufferViews/0/byteLength", "/accessors/0/byteOffset",
              "/accessors/0/count", "/accessors/0/sparse/indices/byteOffset",
              "/accessors/0/sparse/values/byteOffset"}) {
            GltfBuilder builder = makeFullFile();
            builder.json[Json::json_pointer(place)] = number;
            expectRefused(builder, place);
        }
    }
}

TEST(GltfHostile, ElementsBeyondTheirViewAreRefused) {
    for (const auto& [place, value] :
         std::vector<std::pair<const char*, int>>{{"/accessors/0/count", 5},
                                                  {"/accessors/0/byteOffset", 24},
                                                  {"/bufferViews/0/byteLength", 127},
                                                  {"/bufferViews/0/byteOffset", 2},
                                                  {"/bufferViews/0/byteStride", 2},
                                                  {"/bufferViews/0/byteStride", 8},
                                                  {"/bufferViews/0/byteStride", 30},
                                                  {"/bufferViews/0/byteStride", 256},
                                                  {"/accessors/0/byteOffset", 2},
                                                  {"/accessors/0/sparse/count", 2},
                                                  {"/accessors/0/sparse/count", 0}}) {
        GltfBuilder builder = makeFullFile();
        if (std::string(place) == "/bufferViews/0/byteLength")
            builder.json["accessors"][2]["byteOffset"] = 24;
        builder.json[Json::json_pointer(place)] = value;
        expectRefused(builder, std::string(place) + " made " + std::to_string(value));
    }
}

GltfBuilder makeIndexedFile(const std::vector<std::uint8_t>& corners, std::size_t vertexCount) {
    GltfBuilder builder;
    const auto positions = builder.addVectors(std::vector<float>(3 * vertexCount, 1.0f));
    const auto indices = builder.addArray(corners, "SCALAR", corners.size());
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    return builder;
}

TEST(GltfHostile, IndicesMustBeVertices) {  // F5, F6
    EXPECT_NO_THROW(makeIndexedFile({0, 1, 2}, 3).read());
    expectRefused(makeIndexedFile({0, 1, 3}, 3), "an index beyond the vertices");
    expectRefused(makeIndexedFile({0, 1, 255}, 300), "a primitive restart");
    GltfBuilder floats = makeTriangleFile();
    floats.json["meshes"][0]["primitives"][0]["indices"] = 0;
    expectRefused(floats, "positions for indices");
}

TEST(GltfHostile, PositionsMustBeFinite) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
        GltfBuilder builder;
        builder.addMeshNode(
            {{"attributes", {{"POSITION", builder.addVectors({0, 0, 0, 1, bad, 0, 0, 1, 0})}}}});
        const ScratchFolder folder;
        try {
            readGltf(folder.write("scene.glb", builder.glb()));
            FAIL() << bad << " was accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::malformed);
            EXPECT_NE(std::string(error.what()).find("meshes[0].primitives[0].attributes.POSITION"),
                      std::string::npos);
        }
    }
}

TEST(GltfHostile, TransformsThatOverflowAreRefused) {
    GltfBuilder builder = makeTriangleFile();
    builder.json["nodes"][0]["scale"] = {1e30, 1e30, 1e30};
    builder.add("nodes", {{"children", {0}}, {"scale", {1e30, 1e30, 1e30}}});
    expectRefused(builder, "beyond float");
    builder.json["nodes"][1]["scale"] = {1e300, 1e300, 1e300};
    builder.json["nodes"][0]["scale"] = {1e300, 1e300, 1e300};
    expectRefused(builder, "beyond double");
}

TEST(GltfHostile, NodesMustBeAForest) {
    GltfBuilder own = makeTriangleFile();
    own.json["nodes"][0]["children"] = {0};
    expectRefused(own, "its own child");
    GltfBuilder circle = makeTriangleFile();
    circle.add("nodes", {{"children", {2}}});
    circle.add("nodes", {{"children", {1}}});
    expectRefused(circle, "a circle beside the scene");
    GltfBuilder shared = makeTriangleFile();
    shared.add("nodes", {{"children", {0}}});
    shared.add("nodes", {{"children", {0}}});
    expectRefused(shared, "two parents");
    GltfBuilder inner = makeTriangleFile();
    inner.add("nodes", {{"children", {0}}});
    inner.json["scene"] = 0;
    inner.json["scenes"] = {{{"nodes", {0}}}};
    expectRefused(inner, "a scene whose root has a parent");
    GltfBuilder twice = makeTriangleFile();
    twice.json["scenes"] = {{{"nodes", {0, 0}}}};
    expectRefused(twice, "a scene that lists a node twice");
}

TEST(GltfHostile, MalformedTransformsAreRefused) {
    for (const Json& node : {Json{{"rotation", {0, 0, 0, 0}}}, Json{{"rotation", {1, 1, 1, 1}}},
                             Json{{"scale", {1, 1}}}, Json{{"matrix", {1, 0, 0, 1}}},
                             Json{{"matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}},
                             Json{{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                                  {"scale", {1, 1, 1}}}}) {
        GltfBuilder builder = makeTriangleFile();
        builder.json["nodes"][0].update(node);
        expectRefused(builder, node.dump());
    }
}

TEST(GltfHostile, DeepJsonIsRefused) {
    for (const std::string& nest :
         {std::string(100'000, '['), std::string(100'000, '[') + std::string(100'000, ']')})
        EXPECT_FALSE(isRead(nest));
    std::string objects = R"({"asset":{"version":"2.0"},"extras":)";
    for (int i = 0; i < 100'000; ++i)
        objects += "{\"a\":";
    EXPECT_FALSE(isRead(objects));
}

TEST(GltfHostile, TextThatIsNoGltfIsRefused) {
    const ScratchFolder folder;
    for (const char* text : {"", " ", "null", "[]", "{}", "\"glTF\"", "glTF", "{\"asset\":1}",
                             R"({"asset":{"version":2}})", R"({"asset":{"version":"1.0"}})",
                             R"({"asset":{"version":"2.0","minVersion":"2.1"}})",
                             R"({"asset":{"version":"2.0"}})", R"({"asset":{"version":"2.0"}} x)",
                             R"({"asset":{"version":"2.0"},"extras":1e999})", "{\"\xff\":1}"})
        EXPECT_FALSE(isRead(std::string(text))) << text;
    EXPECT_THROW(readGltf(folder.path() / "absent.gltf"), Error);
    EXPECT_THROW(readGltf(folder.path()), Error);
}

TEST(GltfHostile, AVersionIsTwoNumbers) {
    GltfBuilder builder = makeTriangleFile();
    builder.json["asset"]["version"] = "2.17";
    EXPECT_TRUE(isRead(builder.gltf()));
    for (const char* version : {"2.", "2.x", "2. ", "2.0.1", "2", "02.0"}) {
        builder.json["asset"]["version"] = version;
        expectRefused(builder, version);
    }
}

TEST(GltfHostile, NothingFollowsAZeroByte) {
    const std::string text = makeTriangleFile().gltf();
    EXPECT_TRUE(isRead(text + " "));
    EXPECT_FALSE(isRead(text + '\0'));
    EXPECT_FALSE(isRead(text + '\0' + "x"));
}

TEST(GltfHostile, CountsWithoutBytesBehindThemAreLimited) {
    // A sparse accessor without a view has as many zeros as it says.
    GltfBuilder builder = makeTriangleFile();
    builder.json["accessors"][0].erase("bufferView");
    for (const char* count : {"2147483648", "9007199254740992"}) {
        builder.json["accessors"][0]["count"] = Json::parse(count);
        expectRefused(builder, count);
    }
    builder.json["accessors"][0]["count"] = 3'000'000;
    expectRefused(builder, "gigabytes of zeros from a few bytes");
    builder.json["accessors"][0]["count"] = 3;
    EXPECT_TRUE(isRead(builder));
    builder.json["accessors"][0]["byteOffset"] = 0;
    expectRefused(builder, "an offset into no view");
}

TEST(GltfHostile, StridesMustFit) {
    GltfBuilder builder = makeTriangleFile();
    builder.json["bufferViews"][0]["byteStride"] = 12;
    EXPECT_TRUE(isRead(builder));
    builder.json["bufferViews"][0]["target"] = 34963;
    expectRefused(builder, "a stride in a view of indices");
    builder.json["bufferViews"][0]["target"] = 34962;
    builder.json["bufferViews"][0]["byteStride"] = 40;
    expectRefused(builder, "a stride beyond the view");
}

TEST(GltfHostile, AttributesAreNoLongIntegers) {
    GltfBuilder builder = makeTriangleFile();
    const auto ids = builder.addArray(std::vector<std::uint32_t>{1, 2, 3}, "SCALAR", 3);
    builder.json["meshes"][0]["primitives"][0]["attributes"]["_ID"] = ids;
    expectRefused(builder, "an attribute of 32-bit integers");
}

}  // namespace
}  // namespace prt::test
