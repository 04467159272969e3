#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "prt/asset/asset.h"
#include "prt/base/error.h"
#include "prt/gltf/vertex_order.h"
#include "tests/asset/asset_builder.h"
#include "tests/support/kept_assets.h"

namespace prt {
namespace {

using test::GlbFile;
using test::makeGrid;
using Json = nlohmann::json;

constexpr int kBandCount = 2;

Scene makeScene() {
    Scene scene;
    scene.materials.resize(1);
    scene.meshes = {makeGrid("floor", 12, 0.0f), makeGrid("table", 3, 1.0f)};
    return scene;
}

/// Transfer that changes little from vertex to vertex, so that it takes fewer bytes encoded.
CompressedTransfer makeSmoothTransfer(const Scene& scene, TransferEncoding encoding) {
    CompressedTransfer transfer =
        test::makeTransfer(scene, kBandCount, encoding, {Transport::shadowed});
    transfer.receiverCount = scene.vertexCount();
    std::iota(transfer.receiverOfVertex.begin(), transfer.receiverOfVertex.end(), 0u);
    StoredTable& table = transfer.layers[0].table;
    const std::size_t rowBytes = 4 * table.numbers.elementBytes();
    table.numbers = CoefficientTable(scene.vertexCount(), 4, table.numbers.elementBytes());
    for (std::size_t receiver = 0; receiver < scene.vertexCount(); ++receiver) {
        // For floats, the low bits of numbers near 0.
        std::vector<std::byte> row(rowBytes);
        for (std::size_t column = 0; column < 4; ++column)
            row[column * rowBytes / 4] = static_cast<std::byte>(receiver * (column + 1));
        table.numbers.writeRows(receiver, std::span<const std::byte>(row));
    }
    return transfer;
}

std::vector<std::byte> encodeSmooth(TransferEncoding encoding) {
    const Scene scene = makeScene();
    return encodeAsset(scene, makeSmoothTransfer(scene, encoding), test::makeProvenance(),
                       {.meshopt = true});
}

std::optional<Error> refusalOf(std::span<const std::byte> bytes) {
    try {
        decodeAsset({bytes.begin(), bytes.end()}, "damaged.prt.glb");
        return std::nullopt;
    } catch (const Error& error) {
        return error;
    }
}

class MeshoptAsset : public testing::TestWithParam<TransferEncoding> {};

TEST_P(MeshoptAsset, EveryStoredNumberComesBack) {
    const Scene scene = makeScene();
    const CompressedTransfer transfer = makeSmoothTransfer(scene, GetParam());
    const std::vector<std::byte> encoded = encodeSmooth(GetParam());
    test::keepAsset(encoded);
    EXPECT_LT(encoded.size(), encodeAsset(scene, transfer, test::makeProvenance()).size());
    const Asset asset = decodeAsset(encoded, "small.prt.glb");
    EXPECT_TRUE(asset.transfer.layers[0].table.numbers == transfer.layers[0].table.numbers);
    EXPECT_EQ(asset.transfer.layers[0].table.scale, transfer.layers[0].table.scale);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        EXPECT_EQ(asset.scene.meshes[m].positions, scene.meshes[m].positions);
        EXPECT_EQ(asset.scene.meshes[m].triangleCount(), scene.meshes[m].triangleCount());
    }
}

TEST_P(MeshoptAsset, TransferGoesWithItsVertexThroughAnotherOrder) {
    Scene scene = makeScene();
    CompressedTransfer transfer = makeSmoothTransfer(scene, GetParam());
    orderForEncoding(scene, transfer.receiverOfVertex);
    const Asset asset = decodeAsset(
        encodeAsset(scene, transfer, test::makeProvenance(), {.meshopt = true}), "small.prt.glb");
    const Scene before = makeScene();
    const std::vector<float> expected = expandLayer(transfer.layers[0]);
    const std::vector<float> read = expandLayer(asset.transfer.layers[0]);
    ASSERT_EQ(read.size(), expected.size());
    std::size_t movedCount = 0;
    const std::size_t floorCount = before.meshes[0].vertexCount();
    for (std::size_t v = 0; v < scene.vertexCount(); ++v) {
        const std::size_t old = transfer.receiverOfVertex[v], m = v < floorCount ? 0 : 1;
        const std::size_t first = m * floorCount;
        movedCount += old != v;
        ASSERT_EQ(asset.scene.meshes[m].positions[v - first],
                  before.meshes[m].positions[old - first]);
        for (std::size_t i = 0; i < 4; ++i)
            ASSERT_EQ(read[4 * v + i], expected[4 * old + i]);
    }
    EXPECT_GT(movedCount, floorCount / 2);
}

TEST_P(MeshoptAsset, EveryPrefixIsRefused) {
    const std::vector<std::byte> bytes = encodeSmooth(GetParam());
    EXPECT_FALSE(refusalOf(bytes));
    for (std::size_t size = 0; size < bytes.size(); ++size)
        ASSERT_TRUE(refusalOf(std::span(bytes).first(size))) << size << " bytes";
}

// The padding of the chunk alone belongs to no view.
TEST_P(MeshoptAsset, EveryChangedByteOfTheBufferIsRefused) {
    std::vector<std::byte> bytes = encodeSmooth(GetParam());
    const std::size_t begin = test::findBinaryChunk(bytes);
    const std::size_t byteLength = test::splitGlb(bytes).json["buffers"][0]["byteLength"];
    EXPECT_LT(bytes.size() - begin - byteLength, 4u);
    for (std::size_t i = begin; i < begin + byteLength; ++i) {
        bytes[i] ^= std::byte{0x81};
        ASSERT_TRUE(refusalOf(bytes)) << "byte " << i;
        bytes[i] ^= std::byte{0x81};
    }
}

TEST_P(MeshoptAsset, NumbersThatChangeBehindFittingChecksumsOfViewsAreRefused) {
    GlbFile file = test::splitGlb(encodeSmooth(GetParam()));
    const std::size_t accessor = file.json["meshes"][0]["primitives"][0]["attributes"]["_PRT_0"];
    const std::size_t index = file.json["accessors"][accessor]["bufferView"];
    const Json& object = file.json["bufferViews"][index]["extensions"]["EXT_meshopt_compression"];
    const auto stored = std::span(file.binary).subspan(object["byteOffset"], object["byteLength"]);
    stored.back() ^= std::byte{1};  // of the first vertex
    test::headerOf(file)["checksums"][index] = test::checksumOf(stored);
    const std::optional<Error> refusal = refusalOf(test::joinGlb(file));
    ASSERT_TRUE(refusal);
    EXPECT_NE(std::string(refusal->what()).find("not what was baked"), std::string::npos)
        << refusal->what();
}

INSTANTIATE_TEST_SUITE_P(All, MeshoptAsset,
                         testing::Values(TransferEncoding::float32, TransferEncoding::unorm16,
                                         TransferEncoding::unorm8),
                         [](const auto& parameter) {
                             return std::string(encodingName(parameter.param));
                         });

}  // namespace
}  // namespace prt
