// Files of every released version of the format are kept in golden/, and are read for ever. A new
// version adds its own: asset_tests --gtest_also_run_disabled_tests --gtest_filter=*WriteTheFiles*

#include <gtest/gtest.h>

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
CoefficientTable makeStored(std::size_t columnCount, float unit) {
    std::vector<Stored> numbers;
    for (std::size_t vertex = 0; vertex < kVertexCount; ++vertex)
        for (std::size_t column = 0; column < columnCount; ++column)
            numbers.push_back(
                static_cast<Stored>(static_cast<float>(storedNumber(vertex, column)) * unit));
    return makeTable(columnCount, numbers);
}

CompressedTransfer makeGoldenTransfer(TransferEncoding encoding) {
    CompressedTransfer transfer{kBandCount, kVertexCount, {}, {}};
    transfer.receiverOfVertex.resize(kVertexCount);
    std::iota(transfer.receiverOfVertex.begin(), transfer.receiverOfVertex.end(), 0u);
    for (const Transport transport : {Transport::shadowed, Transport::interreflected}) {
        CompressedLayer layer;
        layer.transport = transport;
        layer.channelCount = transport == Transport::interreflected ? 3 : 1;
        layer.table.encoding = encoding;
        const std::size_t columnCount = coefficientsPerReceiver(kBandCount, layer.channelCount);
        if (encoding == TransferEncoding::float32) {
            layer.table.numbers = makeStored<float>(columnCount, 1.0f / 1024.0f);
        } else {
            for (std::size_t column = 0; column < columnCount; ++column) {
                layer.table.scale.push_back(0.5f + static_cast<float>(column) / 64.0f);
                layer.table.bias.push_back(-0.25f);
            }
            layer.table.numbers = encoding == TransferEncoding::unorm16
                                      ? makeStored<std::uint16_t>(columnCount, 1.0f)
                                      : makeStored<std::uint8_t>(columnCount, 1.0f);
        }
        transfer.layers.push_back(std::move(layer));
    }
    return transfer;
}

fs::path goldenPath(const std::string& version, TransferEncoding encoding) {
    return fs::path(__FILE__).parent_path() / "golden" /
           (version + "-" + std::string(encodingName(encoding)) + ".prt.glb");
}

class GoldenAsset : public testing::TestWithParam<std::tuple<const char*, TransferEncoding>> {};

TEST_P(GoldenAsset, OfEveryReleasedVersionIsRead) {
    const auto& [version, encoding] = GetParam();
    const Asset asset = readAsset(goldenPath(version, encoding));
    EXPECT_EQ(asset.provenance.generator, "OpenPRT 0.1.0");
    EXPECT_EQ(asset.provenance.seed, 18446744073709551615u);
    const Scene scene = test::makeTwoGrids();
    ASSERT_EQ(asset.scene.meshes.size(), 2u);
    for (std::size_t mesh = 0; mesh < 2; ++mesh) {
        EXPECT_EQ(asset.scene.meshes[mesh].positions, scene.meshes[mesh].positions);
        ASSERT_EQ(asset.scene.meshes[mesh].normals.size(), scene.meshes[mesh].normals.size());
        for (std::size_t i = 0; i < scene.meshes[mesh].normals.size(); ++i)
            EXPECT_LT(
                (asset.scene.meshes[mesh].normals[i] - scene.meshes[mesh].normals[i]).length(),
                1e-6f);  // normalised as they are read
        EXPECT_EQ(asset.scene.meshes[mesh].indices, scene.meshes[mesh].indices);
    }
    EXPECT_EQ(asset.transfer.bandCount, kBandCount);
    ASSERT_EQ(asset.transfer.receiverCount, kVertexCount);
    ASSERT_EQ(asset.transfer.layers.size(), 2u);
    for (const CompressedLayer& layer : asset.transfer.layers) {
        EXPECT_EQ(layer.table.encoding, encoding);
        const std::vector<float> values = expandLayer(layer);
        const std::size_t columnCount = coefficientsPerReceiver(kBandCount, layer.channelCount);
        ASSERT_EQ(values.size(), kVertexCount * columnCount);
        for (std::size_t i = 0; i < values.size(); ++i)
            EXPECT_EQ(values[i], coefficient(encoding, i / columnCount, i % columnCount)) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, GoldenAsset,
    testing::Combine(testing::Values("1.0"),
                     testing::Values(TransferEncoding::float32, TransferEncoding::unorm16,
                                     TransferEncoding::unorm8)),
    [](const auto& parameter) { return std::string(encodingName(std::get<1>(parameter.param))); });

TEST(GoldenAssets, DISABLED_WriteTheFilesOfThisVersion) {
    const std::string version =
        std::to_string(kAssetVersionMajor) + "." + std::to_string(kAssetVersionMinor);
    for (const TransferEncoding encoding :
         {TransferEncoding::float32, TransferEncoding::unorm16, TransferEncoding::unorm8})
        writeAsset(goldenPath(version, encoding), test::makeTwoGrids(),
                   makeGoldenTransfer(encoding), test::makeProvenance());
}

}  // namespace
}  // namespace prt
