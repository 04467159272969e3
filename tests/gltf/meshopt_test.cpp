#include "prt/gltf/meshopt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <initializer_list>

#include "prt/base/error.h"
#include "prt/base/random.h"
#include "tests/gltf/meshopt_file.h"
#include "tests/gltf/safe_reading.h"

namespace prt {
namespace {

using gltf::decodeMeshopt;
using gltf::encodeMeshopt;
using gltf::MeshoptFilter;
using gltf::MeshoptMode;
using gltf::MeshoptView;
using test::GltfBuilder;
using test::Json;
using test::makeMeshoptFile;

std::vector<std::byte> makeBytes(std::initializer_list<int> numbers) {
    std::vector<std::byte> bytes;
    for (const int number : numbers)
        bytes.push_back(static_cast<std::byte>(number & 0xff));
    return bytes;
}

template <class Value>
std::vector<Value> valuesOf(std::span<const std::byte> bytes) {
    std::vector<Value> values(bytes.size() / sizeof(Value));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(Value));
    return values;
}

/// Attributes that are all the same: a block whose deltas are all 0, and the element in the tail.
std::vector<std::byte> encodeEqual(const std::vector<std::byte>& element) {
    std::vector<std::byte> encoded = makeBytes({0xa0});
    encoded.resize(1 + element.size() + std::max<std::size_t>(32, element.size()));
    std::copy(element.rbegin(), element.rend(), encoded.rbegin());
    return encoded;
}

// The example of the extension's Appendix A: sixteen deltas in four bits each, two of them beyond.
TEST(Meshopt, TheSpecificationsExampleOfDeltasIsDecoded) {
    std::vector<std::byte> encoded =
        makeBytes({0xa0, 2, 0x17, 0x5f, 0xf0, 0xbc, 0x77, 0xa9, 0x21, 0x00, 0x34, 0xb5, 0, 0, 0});
    encoded.resize(encoded.size() + 28);
    for (const int baseline : {100, 7, 8, 9})
        encoded.push_back(static_cast<std::byte>(baseline));
    const std::vector<std::byte> decoded = decodeMeshopt({.count = 16, .byteStride = 4}, encoded);
    const std::array<int, 16> deltas = {-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0};
    int expected = 100;
    for (std::size_t i = 0; i < deltas.size(); ++i) {
        expected += deltas[i];
        EXPECT_EQ(std::to_integer<int>(decoded[4 * i]), expected & 0xff) << i;
        EXPECT_EQ(std::to_integer<int>(decoded[4 * i + 3]), 9);
    }
}

// By the rules of the same appendix: three new vertices; the last edge, (0, 2), and a new vertex.
TEST(Meshopt, TwoTrianglesWrittenByHandAreDecoded) {
    std::vector<std::byte> encoded = makeBytes({0xe1, 0xf0, 0x00});
    encoded.resize(encoded.size() + 16);
    for (const std::size_t stride : {2u, 4u}) {
        const std::vector<std::byte> decoded = decodeMeshopt(
            {.mode = MeshoptMode::triangles, .count = 6, .byteStride = stride}, encoded);
        ASSERT_EQ(decoded.size(), 6 * stride);
        const std::array<int, 6> expected = {0, 1, 2, 0, 2, 3};
        for (std::size_t i = 0; i < 6; ++i)
            EXPECT_EQ(std::to_integer<int>(decoded[i * stride]), expected[i]);
    }
}

TEST(Meshopt, IndicesWrittenByHandAreDecoded) {
    const std::vector<std::byte> encoded = makeBytes({0xd1, 0, 20, 6, 0, 0, 0, 0});
    EXPECT_EQ(valuesOf<std::uint16_t>(decodeMeshopt(
                  {.mode = MeshoptMode::indices, .count = 3, .byteStride = 2}, encoded)),
              (std::vector<std::uint16_t>{0, 5, 3}));
}

// Appendix B: a direction by two of its numbers, and 3 · 2⁻¹.
TEST(Meshopt, FiltersAreAppliedAfterDecoding) {
    const std::vector<std::byte> normals =
        decodeMeshopt({.filter = MeshoptFilter::octahedral, .count = 2, .byteStride = 4},
                      encodeEqual(makeBytes({-127, 0, 127, 5})));
    EXPECT_EQ(valuesOf<std::int8_t>(normals),
              (std::vector<std::int8_t>{-127, 0, 0, 5, -127, 0, 0, 5}));
    const std::vector<std::byte> numbers =
        decodeMeshopt({.filter = MeshoptFilter::exponential, .count = 1, .byteStride = 8},
                      encodeEqual(makeBytes({3, 0, 0, -1, -2, -1, -1, 4})));
    EXPECT_EQ(valuesOf<float>(numbers), (std::vector<float>{1.5f, -32.0f}));
    // The largest number is w: the identity.
    const std::vector<std::byte> rotation =
        decodeMeshopt({.filter = MeshoptFilter::quaternion, .count = 1, .byteStride = 8},
                      encodeEqual(makeBytes({0, 0, 0, 0, 0, 0, 0xff, 0x7f})));
    EXPECT_EQ(valuesOf<std::int16_t>(rotation), (std::vector<std::int16_t>{0, 0, 0, 32767}));
}

TEST(Meshopt, AttributesComeBackBitForBit) {
    RandomStream random(5, 1);
    for (const std::size_t byteStride : {4u, 8u, 12u, 16u, 64u, 256u}) {
        for (const std::size_t count : {1u, 15u, 16u, 17u, 255u, 256u, 257u, 1000u}) {
            for (const bool isSmooth : {false, true}) {
                std::vector<std::byte> bytes(count * byteStride);
                for (std::size_t i = 0; i < bytes.size(); ++i)
                    bytes[i] = static_cast<std::byte>(
                        isSmooth ? i / byteStride * (i % byteStride) / 8 : random.nextBits());
                const MeshoptView view{.count = count, .byteStride = byteStride};
                EXPECT_EQ(decodeMeshopt(view, encodeMeshopt(view, bytes)), bytes);
            }
        }
    }
}

/// The corners of a triangle from the smallest on.
template <class Index>
std::array<Index, 3> turnTriangle(const Index* corners) {
    std::array<Index, 3> triangle = {corners[0], corners[1], corners[2]};
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
    return triangle;
}

template <class Index>
void expectTrianglesComeBack(std::size_t vertexCount) {
    RandomStream random(6, vertexCount);
    for (const std::size_t triangleCount : {1u, 2u, 1000u}) {
        std::vector<Index> indices;
        while (indices.size() < 3 * triangleCount) {
            const auto next = static_cast<Index>(random.nextBits() % vertexCount);
            const std::size_t corner = indices.size() % 3;
            if (std::find(indices.end() - static_cast<std::ptrdiff_t>(corner), indices.end(),
                          next) == indices.end())
                indices.push_back(next);
        }
        const MeshoptView view{
            .mode = MeshoptMode::triangles, .count = indices.size(), .byteStride = sizeof(Index)};
        const std::vector<std::byte> encoded =
            encodeMeshopt(view, std::as_bytes(std::span(indices)));
        EXPECT_EQ(encoded[0], std::byte{0xe1});
        const std::vector<Index> decoded = valuesOf<Index>(decodeMeshopt(view, encoded));
        ASSERT_EQ(decoded.size(), indices.size());
        for (std::size_t i = 0; i < indices.size(); i += 3)
            ASSERT_EQ(turnTriangle(&decoded[i]), turnTriangle(&indices[i])) << i;
    }
}

TEST(Meshopt, TrianglesComeBackInTheirOrder) {
    expectTrianglesComeBack<std::uint16_t>(3);
    expectTrianglesComeBack<std::uint16_t>(65535);
    expectTrianglesComeBack<std::uint32_t>(4'000'000'000u);
}

TEST(Meshopt, NoOtherLengthIsDecoded) {
    const MeshoptView view{.count = 40, .byteStride = 12};
    std::vector<std::byte> bytes(view.decodedBytes());
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<std::byte>(i * i / 7);
    std::vector<std::byte> encoded = encodeMeshopt(view, bytes);
    for (std::size_t length = 0; length < encoded.size(); ++length)
        EXPECT_THROW(decodeMeshopt(view, std::span(encoded).first(length)), Error) << length;
    encoded.push_back(std::byte{0});
    EXPECT_THROW(decodeMeshopt(view, encoded), Error);
}

// 2⁶⁰ bytes that ten cannot stand for.
TEST(Meshopt, NoMemoryIsTakenForMoreThanTheBytesCanStandFor) {
    const std::vector<std::byte> encoded(10);
    for (const MeshoptMode mode :
         {MeshoptMode::attributes, MeshoptMode::triangles, MeshoptMode::indices})
        EXPECT_THROW(
            decodeMeshopt({.mode = mode, .count = 3 * (std::size_t(1) << 56), .byteStride = 4},
                          encoded),
            Error);
}

TEST(MeshoptFile, AnEncodedFileIsRead) {
    const Scene scene = makeMeshoptFile().read();
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.vertexCount(), 9u);
    EXPECT_EQ(scene.triangleCount(), 8u);
    for (std::size_t i = 0; i < 9; ++i)
        EXPECT_EQ(scene.meshes[0].positions[i],
                  Vec3f(static_cast<float>(i % 3), static_cast<float>(i / 3), 0.0f));
}

TEST(MeshoptFile, TheDocumentTellsStoredBytesFromTheViewsOwn) {
    const GltfBuilder builder = makeMeshoptFile();
    const GltfDocument document(builder.glb(), "");
    const Json& object = builder.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"];
    EXPECT_EQ(document.bufferViewBytes(0).size(), 108u);
    const std::span<const std::byte> stored = document.storedViewBytes(0);
    EXPECT_TRUE(std::equal(stored.begin(), stored.end(), builder.bytes.begin()));
    EXPECT_EQ(stored.size(), object["byteLength"]);
}

TEST(MeshoptFile, AFallbackThatIsThereIsNotNeeded) {
    GltfBuilder builder = makeMeshoptFile();
    builder.json["buffers"][1]["uri"] = "absent.bin";
    EXPECT_EQ(builder.read().vertexCount(), 9u);
    builder.json.erase("extensionsRequired");
    EXPECT_EQ(builder.read().vertexCount(), 9u);
}

struct Change {
    const char* name;
    std::function<void(Json& file, Json& view, Json& object)> change;
    const char* complaint;  ///< a part of it
};

TEST(MeshoptFile, ViewsThatTheExtensionForbidsAreRefused) {
    const std::vector<Change> changes = {
        {"no mode", [](Json&, Json&, Json& o) { o.erase("mode"); }, "mode"},
        {"unknown mode", [](Json&, Json&, Json& o) { o["mode"] = "POINTS"; }, "mode"},
        {"unknown filter", [](Json&, Json&, Json& o) { o["filter"] = "COLOR"; }, "filter"},
        {"filter of another stride", [](Json&, Json&, Json& o) { o["filter"] = "OCTAHEDRAL"; },
         "byteStride"},
        {"attributes as triangles", [](Json&, Json&, Json& o) { o["mode"] = "TRIANGLES"; },
         "byteStride"},
        {"a filter of indices",
         [](Json& f, Json&, Json&) {
             f["bufferViews"][1]["extensions"]["EXT_meshopt_compression"]["filter"] = "EXPONENTIAL";
         },
         "filter"},
        {"a part of a triangle",
         [](Json& f, Json&, Json&) {
             f["bufferViews"][1]["byteLength"] = 46;
             f["bufferViews"][1]["extensions"]["EXT_meshopt_compression"]["count"] = 23;
         },
         "count"},
        {"stride 0", [](Json&, Json&, Json& o) { o["byteStride"] = 0; }, "byteStride"},
        {"odd stride", [](Json&, Json&, Json& o) { o["byteStride"] = 6; }, "byteStride"},
        {"long stride", [](Json&, Json&, Json& o) { o["byteStride"] = 260; }, "byteStride"},
        {"two strides", [](Json&, Json& v, Json&) { v["byteStride"] = 16; }, "byteStride"},
        {"another count", [](Json&, Json&, Json& o) { o["count"] = 10; }, "length"},
        {"another length", [](Json&, Json& v, Json&) { v["byteLength"] = 120; }, "length"},
        {"too few bytes",
         [](Json&, Json&, Json& o) { o["byteLength"] = o["byteLength"].get<int>() - 1; },
         "not encoded"},
        {"bytes past the end", [](Json&, Json&, Json& o) { o["byteOffset"] = 100'000; }, "inside"},
        {"bytes of the fallback", [](Json&, Json&, Json& o) { o["buffer"] = 1; }, "without bytes"},
        {"no such buffer", [](Json&, Json&, Json& o) { o["buffer"] = 2; }, "buffer"},
        {"a huge claim",
         [](Json& f, Json& v, Json& o) {
             f["buffers"][1]["byteLength"] = 1'200'000'000'000u;
             v["byteLength"] = 1'200'000'000'000u;
             o["count"] = 100'000'000'000u;
         },
         "more bytes than"}};
    for (const Change& change : changes) {
        SCOPED_TRACE(change.name);
        GltfBuilder builder = makeMeshoptFile();
        Json& view = builder.json["bufferViews"][0];
        change.change(builder.json, view, view["extensions"]["EXT_meshopt_compression"]);
        try {
            builder.read();
            ADD_FAILURE() << "was accepted";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(change.complaint), std::string::npos)
                << error.what();
        }
    }
}

// A view of 64 bytes for each encoded one, and again and again.
TEST(MeshoptFile, TheSameBytesCannotBeDecodedWithoutEnd) {
    GltfBuilder builder = makeMeshoptFile();
    const std::size_t elementCount = 100'000;
    const std::vector<std::byte> zeros(4 * elementCount);
    const std::size_t view = test::addEncodedView(builder, zeros, gltf::MeshoptMode::attributes, 4);
    builder.json["buffers"][0]["byteLength"] = builder.bytes.size();
    builder.json["buffers"][1]["byteLength"] = zeros.size();
    EXPECT_TRUE(test::isRead(builder));
    for (int i = 0; i < 10; ++i)
        builder.json["bufferViews"].push_back(builder.json["bufferViews"][view]);
    try {
        builder.read();
        ADD_FAILURE() << "was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::limitExceeded);
    }
}

TEST(MeshoptFile, NoPrefixIsRead) {
    const std::vector<std::byte> whole = makeMeshoptFile().glb();
    EXPECT_TRUE(test::isRead(std::span(whole)));
    for (std::size_t length = 0; length < whole.size(); ++length)
        ASSERT_FALSE(test::isRead(std::span(whole).first(length))) << length;
}

TEST(MeshoptFile, EveryByteChangeIsSafe) {
    std::vector<std::byte> file = makeMeshoptFile().glb();
    for (std::byte& byte : file) {
        const std::byte original = byte;
        for (unsigned change = 1; change < 256; change += 9) {
            byte = original ^ static_cast<std::byte>(change);
            test::isRead(std::span<const std::byte>(file));
            ASSERT_FALSE(HasFailure());
        }
        byte = original;
    }
}

TEST(MeshoptFile, EveryValueMayBeOfAnyTypeAndSizeOrMissing) {
    const GltfBuilder whole = makeMeshoptFile();
    const Json flat = whole.json.flatten();
    for (const auto& [pointer, unused] : flat.items()) {
        for (Json::json_pointer place(pointer); !place.empty(); place.pop_back()) {
            for (const char* value : {"null", "true", "-1", "0.5", "4294967295", "9007199254740992",
                                      "1e300", "\"0\"", "[]", "{}", "[0]"}) {
                GltfBuilder changed = whole;
                changed.json[place] = Json::parse(value);
                test::isRead(changed);
                ASSERT_FALSE(HasFailure()) << place << " made " << value;
            }
        }
    }
}

}  // namespace
}  // namespace prt
