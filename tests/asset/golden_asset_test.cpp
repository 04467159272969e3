// Files of every released version of the format are kept in golden/, and are read for ever. A new
// version adds its own: asset_tests --gtest_also_run_disabled_tests --gtest_filter=*WriteTheFiles*

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

#include "prt/asset/asset.h"
#include "tests/asset/asset_builder.h"

namespace prt {
namespace {

namespace fs = std::filesystem;

constexpr int kBandCount = 2;
constexpr std::size_t kVertexCount = 13;  // of makeTwoGrids

/// The number that is stored of a vertex in a column.
unsigned storedNumber(std::size_t vertex, std::size_t column) {
    return static_cast<unsigned>((17 * vertex + 5 * column) % 251);
}

/// What a coefficient is, from that number.
float coefficient(TransferEncoding encoding, std::size_t vertex, std::size_t column) {
    const double number = storedNumber(vertex, column);
    if (encoding == TransferEncoding::float32) return static_cast<float>(number) / 1024.0f;
    const double largest = encoding == TransferEncoding::unorm16 ? 65535.0 : 255.0;
    return static_cast<float>(-0.25 +
                              (0.5 + static_cast<double>(column) / 64.0) * number / largest);
}

template <class Stored>
CoefficientTable makeStored(std::size_t rowCount, std::size_t columnCount, float unit) {
    std::vector<Stored> numbers;
    for (std::size_t vertex = 0; vertex < rowCount; ++vertex)
        for (std::size_t column = 0; column < columnCount; ++column)
            numbers.push_back(
                static_cast<Stored>(static_cast<float>(storedNumber(vertex, column)) * unit));
    return makeTable(columnCount, numbers);
}

/// Rows of coefficients as they are stored.
StoredTable makeGoldenTable(TransferEncoding encoding, std::size_t rowCount,
                            std::size_t columnCount) {
    StoredTable table{.encoding = encoding};
    if (encoding == TransferEncoding::float32) {
        table.numbers = makeStored<float>(rowCount, columnCount, 1.0f / 1024.0f);
        return table;
    }
    for (std::size_t column = 0; column < columnCount; ++column) {
        table.scale.push_back(0.5f + static_cast<float>(column) / 64.0f);
        table.bias.push_back(-0.25f);
    }
    table.numbers = encoding == TransferEncoding::unorm16
                        ? makeStored<std::uint16_t>(rowCount, columnCount, 1.0f)
                        : makeStored<std::uint8_t>(rowCount, columnCount, 1.0f);
    return table;
}

/// Version 1.0.
CompressedTransfer makeGoldenTransfer(TransferEncoding encoding) {
    CompressedTransfer transfer{kBandCount, kVertexCount, {}, {}};
    transfer.receiverOfVertex.resize(kVertexCount);
    std::iota(transfer.receiverOfVertex.begin(), transfer.receiverOfVertex.end(), 0u);
    for (const Transport transport : {Transport::shadowed, Transport::interreflected}) {
        CompressedLayer layer;
        layer.transport = transport;
        layer.channelCount = transport == Transport::interreflected ? 3 : 1;
        layer.table = makeGoldenTable(encoding, kVertexCount,
                                      coefficientsPerReceiver(kBandCount, layer.channelCount));
        transfer.layers.push_back(std::move(layer));
    }
    return transfer;
}

// Version 1.1: the second layer has three clusters, which vertices are in by turns.
const std::vector<std::uint32_t> kComponentCounts = {2, 0, 1};
constexpr std::array<std::size_t, 3> kFirstVectors = {0, 3, 4};
constexpr std::size_t kVectorCount = 6;

template <class Stored>
CoefficientTable makeWeights(float unit) {
    std::vector<Stored> numbers;
    for (std::size_t vertex = 0; vertex < kVertexCount; ++vertex) {
        numbers.push_back(static_cast<Stored>(vertex % 3));
        for (std::size_t p = 1; p <= 2; ++p) {
            const auto number = static_cast<float>(storedNumber(vertex, p));
            const bool isThere = p <= kComponentCounts[vertex % 3];
            numbers.push_back(static_cast<Stored>(isThere ? number * unit : 0.0f));
        }
    }
    return makeTable(3, numbers);
}

CompressedTransfer makeGoldenClusters(TransferEncoding encoding) {
    CompressedTransfer transfer = makeGoldenTransfer(encoding);
    CompressedLayer& layer = transfer.layers[1];
    const std::size_t dimension = layer.table.numbers.columnCount();
    layer.bases = {kComponentCounts, makeGoldenTable(encoding, kVectorCount, dimension)};
    layer.table = {.encoding = encoding};
    if (encoding == TransferEncoding::float32)
        layer.table.numbers = makeWeights<float>(1.0f / 256.0f);
    else if (encoding == TransferEncoding::unorm16)
        layer.table.numbers = makeWeights<std::uint16_t>(257.0f);
    else
        layer.table.numbers = makeWeights<std::uint8_t>(1.0f);
    return transfer;
}

/// Version 1.2: and matrices, of 3 and of 2 bands of incident radiance, the second in clusters.
CompressedTransfer makeGoldenMatrices(TransferEncoding encoding) {
    CompressedTransfer transfer = makeGoldenClusters(encoding);
    CompressedLayer shadowed{.transport = Transport::glossyShadowed, .incidentBandCount = 3};
    shadowed.table = makeGoldenTable(encoding, kVertexCount, 9 * 4);
    CompressedLayer glossy = transfer.layers[1];
    glossy.transport = Transport::glossy;
    glossy.incidentBandCount = 2;
    glossy.bases->vectors = makeGoldenTable(encoding, kVectorCount, 3 * 4 * 4);
    transfer.layers.push_back(std::move(shadowed));
    transfer.layers.push_back(std::move(glossy));
    return transfer;
}

/// A coefficient of a layer with those clusters.
double coefficientOfClusters(TransferEncoding encoding, std::size_t vertex, std::size_t column) {
    const std::size_t cluster = vertex % 3;
    double sum = coefficient(encoding, kFirstVectors[cluster], column);
    for (std::size_t p = 1; p <= kComponentCounts[cluster]; ++p) {
        const double largest = encoding == TransferEncoding::float32 ? 256.0 : 255.0;
        sum += storedNumber(vertex, p) / largest *
               coefficient(encoding, kFirstVectors[cluster] + p, column);
    }
    return sum;
}

fs::path goldenPath(const std::string& version, TransferEncoding encoding) {
    return fs::path(PRT_GOLDEN_FOLDER) /
           (version + "-" + std::string(encodingName(encoding)) + ".prt.glb");
}

/// The scene of all of them, and how it was baked.
Asset readGolden(const std::string& version, TransferEncoding encoding) {
    Asset asset = readAsset(goldenPath(version, encoding));
    EXPECT_EQ(asset.provenance.generator, "OpenPRT 0.1.0");
    EXPECT_EQ(asset.provenance.seed, 18446744073709551615u);
    const Scene scene = test::makeTwoGrids();
    EXPECT_EQ(asset.scene.meshes.size(), 2u);
    for (std::size_t mesh = 0; mesh < asset.scene.meshes.size(); ++mesh) {
        EXPECT_EQ(asset.scene.meshes[mesh].positions, scene.meshes[mesh].positions);
        EXPECT_EQ(asset.scene.meshes[mesh].indices, scene.meshes[mesh].indices);
        const std::vector<Vec3f>& normals = asset.scene.meshes[mesh].normals;
        EXPECT_EQ(normals.size(), scene.meshes[mesh].normals.size());
        for (std::size_t i = 0; i < normals.size(); ++i)
            EXPECT_LT((normals[i] - scene.meshes[mesh].normals[i]).length(),
                      1e-6f);  // normalised as they are read
    }
    EXPECT_EQ(asset.transfer.bandCount, kBandCount);
    EXPECT_EQ(asset.transfer.receiverCount, kVertexCount);
    return asset;
}

void expectCoefficients(const CompressedLayer& layer, TransferEncoding encoding) {
    EXPECT_EQ(layer.table.encoding, encoding);
    const std::vector<float> values = expandLayer(layer);
    const std::size_t columnCount = coefficientsPerReceiver(kBandCount, layer);
    ASSERT_EQ(values.size(), kVertexCount * columnCount);
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(values[i], coefficient(encoding, i / columnCount, i % columnCount)) << i;
}

void expectClusters(const CompressedLayer& layer, TransferEncoding encoding) {
    // expandLayer rounds weights, vectors and their sum to floats.
    constexpr double kRounding = 3e-7;
    ASSERT_TRUE(layer.bases);
    EXPECT_EQ(layer.table.encoding, encoding);
    EXPECT_EQ(layer.bases->vectors.encoding, encoding);
    const std::vector<float> values = expandLayer(layer);
    const std::size_t columnCount = coefficientsPerReceiver(kBandCount, layer);
    ASSERT_EQ(values.size(), kVertexCount * columnCount);
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_NEAR(values[i], coefficientOfClusters(encoding, i / columnCount, i % columnCount),
                    kRounding)
            << i;
}

class GoldenAsset : public testing::TestWithParam<TransferEncoding> {};

TEST_P(GoldenAsset, OfVersion10IsRead) {
    const Asset asset = readGolden("1.0", GetParam());
    ASSERT_EQ(asset.transfer.layers.size(), 2u);
    for (const CompressedLayer& layer : asset.transfer.layers)
        expectCoefficients(layer, GetParam());
}

TEST_P(GoldenAsset, OfVersion11IsRead) {
    const Asset asset = readGolden("1.1", GetParam());
    ASSERT_EQ(asset.transfer.layers.size(), 2u);
    expectCoefficients(asset.transfer.layers[0], GetParam());
    expectClusters(asset.transfer.layers[1], GetParam());
}

TEST_P(GoldenAsset, OfVersion12IsRead) {
    const Asset asset = readGolden("1.2", GetParam());
    const std::vector<CompressedLayer>& layers = asset.transfer.layers;
    ASSERT_EQ(layers.size(), 4u);
    expectCoefficients(layers[0], GetParam());
    expectClusters(layers[1], GetParam());
    EXPECT_EQ(layers[2].transport, Transport::glossyShadowed);
    EXPECT_EQ(layers[2].channelCount, 1);
    EXPECT_EQ(layers[2].incidentBandCount, 3);
    expectCoefficients(layers[2], GetParam());
    EXPECT_EQ(layers[3].transport, Transport::glossy);
    EXPECT_EQ(layers[3].channelCount, 3);
    EXPECT_EQ(layers[3].incidentBandCount, 2);
    expectClusters(layers[3], GetParam());
}

INSTANTIATE_TEST_SUITE_P(All, GoldenAsset,
                         testing::Values(TransferEncoding::float32, TransferEncoding::unorm16,
                                         TransferEncoding::unorm8),
                         [](const auto& parameter) {
                             return std::string(encodingName(parameter.param));
                         });

TEST(GoldenAssets, DISABLED_WriteTheFilesOfThisVersion) {
    const std::string version =
        std::to_string(kAssetVersionMajor) + "." + std::to_string(kAssetVersionMinor);
    for (const TransferEncoding encoding :
         {TransferEncoding::float32, TransferEncoding::unorm16, TransferEncoding::unorm8})
        writeAsset(goldenPath(version, encoding), test::makeTwoGrids(),
                   makeGoldenMatrices(encoding), test::makeProvenance());
}

}  // namespace
}  // namespace prt
