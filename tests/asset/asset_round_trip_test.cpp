#include <gtest/gtest.h>

#include "prt/asset/asset.h"
#include "prt/gltf/gltf_scene.h"
#include "tests/asset/asset_builder.h"
#include "tests/gltf/gltf_builder.h"
#include "tests/support/kept_assets.h"

namespace prt {
namespace {

using test::GlbFile;
using test::makeProvenance;
using test::makeTransfer;
using test::makeTwoGrids;
using test::ScratchFolder;

constexpr std::array kTransports = {Transport::unshadowed, Transport::shadowed,
                                    Transport::interreflected, Transport::glossyShadowed,
                                    Transport::glossy};
constexpr std::array kEncodings = {TransferEncoding::float32, TransferEncoding::unorm16,
                                   TransferEncoding::unorm8};

/// The transports whose bits are set.
std::vector<Transport> combination(unsigned bits) {
    std::vector<Transport> transports;
    for (unsigned i = 0; i < kTransports.size(); ++i)
        if ((bits >> i & 1u) != 0) transports.push_back(kTransports[i]);
    return transports;
}

using StoredRow = std::vector<std::byte>;

/// What is stored of one receiver, byte by byte.
StoredRow rowOf(const CompressedLayer& layer, std::size_t receiver) {
    StoredRow row(layer.table.numbers.columnCount() * layer.table.numbers.elementBytes());
    layer.table.numbers.readRow(receiver, std::span(row));
    return row;
}

void expectSameTransfer(const CompressedTransfer& read, const CompressedTransfer& written) {
    EXPECT_EQ(read.bandCount, written.bandCount);
    ASSERT_EQ(read.receiverCount, written.receiverOfVertex.size());
    ASSERT_EQ(read.receiverOfVertex.size(), read.receiverCount);
    for (std::uint32_t i = 0; i < read.receiverCount; ++i)
        EXPECT_EQ(read.receiverOfVertex[i], i);
    ASSERT_EQ(read.layers.size(), written.layers.size());
    for (std::size_t i = 0; i < read.layers.size(); ++i) {
        EXPECT_EQ(read.layers[i].transport, written.layers[i].transport);
        EXPECT_EQ(read.layers[i].channelCount, written.layers[i].channelCount);
        EXPECT_EQ(read.layers[i].incidentBandCount, written.layers[i].incidentBandCount);
        EXPECT_EQ(read.layers[i].table.encoding, written.layers[i].table.encoding);
        EXPECT_EQ(read.layers[i].table.scale, written.layers[i].table.scale);
        EXPECT_EQ(read.layers[i].table.bias, written.layers[i].table.bias);
        ASSERT_EQ(read.layers[i].table.numbers.rowCount(), read.receiverCount);
        for (std::size_t vertex = 0; vertex < read.receiverCount; ++vertex)
            EXPECT_EQ(rowOf(read.layers[i], vertex),
                      rowOf(written.layers[i], written.receiverOfVertex[vertex]));
    }
}

TEST(Asset, EveryCombinationOfLayersComesBackBitForBit) {
    const Scene scene = makeTwoGrids();
    const ScratchFolder folder;
    const std::filesystem::path path = folder.path() / "grids.prt.glb";
    for (const TransferEncoding encoding : kEncodings)
        for (unsigned bits = 1; bits < 32; ++bits)
            for (const int bandCount : {1, 3, 10}) {
                SCOPED_TRACE(testing::Message() << encodingName(encoding) << ", layers " << bits
                                                << ", bands " << bandCount);
                const CompressedTransfer transfer =
                    makeTransfer(scene, bandCount, encoding, combination(bits));
                writeAsset(path, scene, transfer, makeProvenance());
                test::keepAsset(path);
                expectSameTransfer(readAsset(path).transfer, transfer);
            }
}

TEST(Asset, TheSceneAndTheProvenanceComeBack) {
    // Readers of glTF normalise normals again: the last bit of a float may change.
    constexpr float kNormalisation = 2e-7f;
    const Scene scene = makeTwoGrids();
    const ScratchFolder folder;
    const std::filesystem::path path = folder.path() / "grids.prt.glb";
    writeAsset(path, scene, makeTransfer(scene, 3, TransferEncoding::unorm16, combination(7)),
               makeProvenance());
    const Asset asset = readAsset(path);
    ASSERT_EQ(asset.scene.meshes.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(asset.scene.meshes[i].name, scene.meshes[i].name);
        EXPECT_EQ(asset.scene.meshes[i].positions, scene.meshes[i].positions);
        for (std::size_t v = 0; v < scene.meshes[i].vertexCount(); ++v)
            EXPECT_LT((asset.scene.meshes[i].normals[v] - scene.meshes[i].normals[v]).length(),
                      kNormalisation);
        EXPECT_EQ(asset.scene.meshes[i].indices, scene.meshes[i].indices);
    }
    const Provenance expected = makeProvenance();
    EXPECT_EQ(asset.provenance.generator, expected.generator);
    EXPECT_EQ(asset.provenance.command, expected.command);
    EXPECT_EQ(asset.provenance.sampleCount, expected.sampleCount);
    EXPECT_EQ(asset.provenance.bounceCount, expected.bounceCount);
    EXPECT_EQ(asset.provenance.seed, expected.seed);
    EXPECT_EQ(asset.provenance.isa, expected.isa);
}

TEST(Asset, AReaderOfPlainGltfSeesThePlainScene) {
    const Scene scene = makeTwoGrids();
    const ScratchFolder folder;
    const auto path = folder.write(
        "grids.glb", encodeAsset(scene, makeTransfer(scene, 3, kEncodings[2], {kTransports[2]}),
                                 makeProvenance()));
    const Scene read = readGltf(path);
    EXPECT_TRUE(read.warnings.empty());
    ASSERT_EQ(read.meshes.size(), 2u);
    EXPECT_EQ(read.meshes[1].positions, scene.meshes[1].positions);
}

TEST(Asset, TheSameBakeGivesTheSameBytes) {
    const Scene scene = makeTwoGrids();
    const CompressedTransfer transfer = makeTransfer(scene, 4, kEncodings[1], combination(7));
    EXPECT_EQ(encodeAsset(scene, transfer, makeProvenance()),
              encodeAsset(scene, transfer, makeProvenance()));
}

/// One coefficient of one vertex, found by docs/format.md alone, without the library's reader.
double coefficientByTheFormat(GlbFile& file, std::size_t mesh, std::size_t vertex,
                              std::size_t layerIndex, std::size_t coefficient) {
    const nlohmann::json layer = test::headerOf(file)["layers"][layerIndex];
    const std::size_t attribute = layer["attributes"]["first"].get<std::size_t>() + coefficient / 4;
    const nlohmann::json& primitive = file.json["meshes"][mesh]["primitives"][0];
    const std::size_t accessor = primitive["attributes"]["_PRT_" + std::to_string(attribute)];
    const std::span<std::byte> bytes =
        file.view(file.json["accessors"][accessor]["bufferView"].get<std::size_t>());
    const std::size_t element = vertex * 4 + coefficient % 4;
    if (layer["encoding"] == "float32") {
        float value = 0.0f;
        std::memcpy(&value, bytes.data() + element * 4, sizeof(value));
        return value;
    }
    std::uint32_t integer = 0;
    const bool isWord = layer["encoding"] == "unorm16";
    std::memcpy(&integer, bytes.data() + element * (isWord ? 2 : 1), isWord ? 2 : 1);
    return layer["bias"][coefficient].get<double>() +
           layer["scale"][coefficient].get<double>() * integer / (isWord ? 65535.0 : 255.0);
}

TEST(Asset, CoefficientsStandWhereTheFormatSays) {
    // expandLayer rounds to a float once.
    constexpr double kRounding = 1e-7;
    const Scene scene = makeTwoGrids();
    const std::vector<std::size_t> offsets = vertexOffsets(scene);
    for (const TransferEncoding encoding : kEncodings) {
        const CompressedTransfer transfer = makeTransfer(scene, 2, encoding, combination(30));
        GlbFile file = test::splitGlb(encodeAsset(scene, transfer, makeProvenance()));
        for (std::size_t layer = 0; layer < 4; ++layer) {
            const std::vector<float> values = expandLayer(transfer.layers[layer]);
            // Of the matrices, 9 and 4 coefficients of incident radiance.
            const std::size_t rowLength = std::array{4, 3 * 4, 9 * 4, 3 * 4 * 4}[layer];
            for (std::size_t mesh = 0; mesh < 2; ++mesh)
                for (std::size_t v = 0; v < scene.meshes[mesh].vertexCount(); ++v)
                    for (std::size_t i = 0; i < rowLength; ++i) {
                        const std::size_t receiver = transfer.receiverOfVertex[offsets[mesh] + v];
                        ASSERT_NEAR(coefficientByTheFormat(file, mesh, v, layer, i),
                                    values[receiver * rowLength + i], kRounding);
                    }
        }
    }
}

// The example of docs/format.md, whose checksum other readers are to be tried on.
TEST(Asset, TheLayerOfTheFormatsExampleHasTheChecksumGivenThere) {
    Scene scene = makeTwoGrids();
    CompressedTransfer transfer =
        makeTransfer(scene, 2, TransferEncoding::unorm16, {Transport::shadowed});
    transfer.layers[0].table.scale = {0.25f, 0.5f, 0.5f, 0.5f};
    transfer.layers[0].table.bias = {0.0f, -0.25f, -0.25f, -0.25f};
    GlbFile file = test::splitGlb(encodeAsset(scene, transfer, makeProvenance()));
    EXPECT_EQ(test::headerOf(file)["layers"][0]["checksum"], "1e97d30d");
}

}  // namespace
}  // namespace prt
