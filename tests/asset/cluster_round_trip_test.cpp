#include <gtest/gtest.h>

#include <algorithm>

#include "prt/asset/asset.h"
#include "prt/asset/check_asset.h"
#include "prt/base/error.h"
#include "tests/asset/asset_builder.h"
#include "tests/asset/asset_damage.h"
#include "tests/support/kept_assets.h"

namespace prt {
namespace {

using test::ClusterForm;
using test::GlbFile;
using test::headerOf;
using test::isSameTransfer;
using test::makeClusteredLayer;
using test::makeClusteredTransfer;
using test::makeProvenance;
using test::makeTwoGrids;

constexpr std::array kEncodings = {TransferEncoding::float32, TransferEncoding::unorm16,
                                   TransferEncoding::unorm8};

Asset writeAndRead(const Scene& scene, const CompressedTransfer& transfer) {
    const std::vector<std::byte> bytes = encodeAsset(scene, transfer, makeProvenance());
    test::keepAsset(bytes);
    return decodeAsset(bytes, "asset");
}

/// The written transfer with a receiver for each vertex, as it is read.
CompressedTransfer spreadOverVertices(const CompressedTransfer& transfer) {
    CompressedTransfer spread = transfer;
    spread.receiverCount = transfer.receiverOfVertex.size();
    for (CompressedLayer& layer : spread.layers) {
        const CoefficientTable numbers = std::move(layer.table.numbers);
        layer.table.numbers =
            CoefficientTable(spread.receiverCount, numbers.columnCount(), numbers.elementBytes());
        std::vector<std::byte> row(numbers.columnCount() * numbers.elementBytes());
        for (std::size_t vertex = 0; vertex < spread.receiverCount; ++vertex) {
            numbers.readRow(transfer.receiverOfVertex[vertex], std::span(row));
            layer.table.numbers.writeRows(vertex, std::span<const std::byte>(row));
        }
    }
    return spread;
}

TEST(AssetWithClusters, EveryFormComesBackBitForBit) {
    const Scene scene = makeTwoGrids();
    for (const TransferEncoding weights : kEncodings)
        for (const TransferEncoding vectors : kEncodings)
            for (const std::vector<std::uint32_t>& componentCounts :
                 {std::vector<std::uint32_t>{0}, {8}, {2, 0, 3, 7}, {0, 0, 0}, {255}})
                for (const int bandCount : {1, 3}) {
                    SCOPED_TRACE(testing::Message()
                                 << encodingName(weights) << " weights, vectors of "
                                 << encodingName(vectors) << ", " << componentCounts.size()
                                 << " clusters, " << bandCount << " bands");
                    const CompressedTransfer transfer =
                        makeClusteredTransfer(scene, bandCount, {weights, vectors, componentCounts},
                                              {Transport::unshadowed, Transport::interreflected,
                                               Transport::glossyShadowed, Transport::glossy});
                    EXPECT_TRUE(isSameTransfer(writeAndRead(scene, transfer).transfer,
                                               spreadOverVertices(transfer)));
                }
}

TEST(AssetWithClusters, LayersWithAndWithoutStandSideBySide) {
    const Scene scene = makeTwoGrids();
    CompressedTransfer transfer =
        test::makeTransfer(scene, 3, TransferEncoding::unorm16, {Transport::unshadowed});
    transfer.layers.push_back(
        makeClusteredLayer(Transport::shadowed, 3, transfer.receiverCount, {}));
    const Asset asset = writeAndRead(scene, transfer);
    EXPECT_TRUE(isSameTransfer(asset.transfer, spreadOverVertices(transfer)));
    EXPECT_EQ(expandLayer(asset.transfer.layers[1]).size(), scene.vertexCount() * 9);
}

TEST(AssetWithClusters, SmallestAndLargestCountsComeBack) {
    const Scene triangle = test::makeTriangle();
    CompressedTransfer transfer{1, 1, {0, 0, 0}, {}};
    transfer.layers = {makeClusteredLayer(Transport::shadowed, 1, 1, {.componentCounts = {0}})};
    EXPECT_TRUE(
        isSameTransfer(writeAndRead(triangle, transfer).transfer, spreadOverVertices(transfer)));

    const auto countsOf = [&](TransferEncoding weights, std::size_t clusterCount) {
        transfer.layers = {makeClusteredLayer(
            Transport::shadowed, 1, 1,
            {.weights = weights, .componentCounts = std::vector<std::uint32_t>(clusterCount, 0)})};
        return writeAndRead(triangle, transfer).transfer.layers[0].bases->clusterCount();
    };
    EXPECT_EQ(countsOf(TransferEncoding::unorm8, 256), 256u);
    EXPECT_EQ(countsOf(TransferEncoding::unorm16, 65536), 65536u);
}

TEST(AssetWithClusters, MoreThanTheFormatCanCountIsNotWritten) {
    const auto expectRefusal = [](TransferEncoding weights, std::vector<std::uint32_t> counts) {
        const CompressedLayer layer = makeClusteredLayer(
            Transport::shadowed, 1, 1, {.weights = weights, .componentCounts = std::move(counts)});
        try {
            encodeAsset(test::makeTriangle(), {1, 1, {0, 0, 0}, {layer}}, makeProvenance());
            ADD_FAILURE() << "it was written";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::limitExceeded);
        }
    };
    expectRefusal(TransferEncoding::unorm8, std::vector<std::uint32_t>(257, 0));
    expectRefusal(TransferEncoding::unorm16, std::vector<std::uint32_t>(65537, 0));
    expectRefusal(TransferEncoding::float32, {256});
}

TEST(AssetWithClusters, IntegersWithoutRangesAreWrittenWithThoseThatChangeNothing) {
    const Scene scene = makeTwoGrids();
    CompressedTransfer transfer = makeClusteredTransfer(scene, 2, {}, {Transport::shadowed});
    StoredTable& written = transfer.layers[0].bases->vectors;
    written.scale.clear();
    written.bias.clear();
    const CompressedTransfer read = writeAndRead(scene, transfer).transfer;
    EXPECT_EQ(read.layers[0].bases->vectors.scale, std::vector<float>(4, 1.0f));
    EXPECT_EQ(expandLayer(read.layers[0]), expandLayer(spreadOverVertices(transfer).layers[0]));
}

TEST(AssetWithClusters, ItIsCheckedByWhatItsVectorsAddUpTo) {
    const Scene triangle = test::makeTriangle();
    CompressedTransfer transfer{1, 1, {0, 0, 0}, {}};
    CompressedLayer layer;
    layer.bases.emplace();
    layer.bases->componentCounts = {1};
    layer.table.numbers = makeTable<float>(2, {0.0f, 0.5f});
    const auto problemsOf = [&](float base, float component) {
        layer.bases->vectors.numbers = makeTable<float>(1, {base, component});
        transfer.layers = {layer};
        return findAssetProblems(writeAndRead(triangle, transfer));
    };
    // White surroundings give 0.2821 and no more: 0.2 + 0.5 · 0.1 is within, 0.2 + 0.5 · 0.2 not.
    EXPECT_TRUE(problemsOf(0.2f, 0.1f).empty());
    ASSERT_EQ(problemsOf(0.2f, 0.2f).size(), 1u);
    EXPECT_NE(problemsOf(0.2f, 0.2f)[0].find("3 of 3"), std::string::npos);
}

/// A number of an array of integers or floats, as a fraction of the largest where that is asked
/// for.
double numberAt(std::span<const std::byte> bytes, const std::string& encoding, std::size_t index,
                bool isFraction = true) {
    if (encoding == "float32") {
        float value = 0.0f;
        std::memcpy(&value, &bytes[index * 4], sizeof(value));
        return value;
    }
    const bool isWord = encoding == "unorm16";
    std::uint32_t integer = 0;
    std::memcpy(&integer, &bytes[index * (isWord ? 2 : 1)], isWord ? 2 : 1);
    return integer / (!isFraction ? 1.0 : isWord ? 65535.0 : 255.0);
}

/// The transfer vector of a vertex by docs/format.md alone, without the library's reader.
std::vector<double> vectorByTheFormat(GlbFile& file, std::size_t mesh, std::size_t vertex,
                                      std::size_t dimension) {
    const nlohmann::json layer = headerOf(file)["layers"][0];
    const nlohmann::json clusters = layer["clusters"];
    const auto numberOfVertex = [&](std::size_t number, bool isFraction) {
        const std::size_t attribute = layer["attributes"]["first"].get<std::size_t>() + number / 4;
        const std::size_t accessor = file.json["meshes"][mesh]["primitives"][0]["attributes"]
                                              ["_PRT_" + std::to_string(attribute)];
        return numberAt(file.view(file.json["accessors"][accessor]["bufferView"]),
                        clusters["weights"], vertex * 4 + number % 4, isFraction);
    };
    const std::size_t accessor = clusters["accessor"];
    const std::span<std::byte> vectors = file.view(file.json["accessors"][accessor]["bufferView"]);
    const std::string encoding = clusters["encoding"];
    const auto numberOfVector = [&](std::size_t row, std::size_t c) {
        const double number = numberAt(vectors, encoding, row * dimension + c);
        return encoding == "float32" ? number
                                     : clusters["bias"][c].get<double>() +
                                           clusters["scale"][c].get<double>() * number;
    };
    const auto k = static_cast<std::size_t>(numberOfVertex(0, false));
    std::size_t row = 0;
    for (std::size_t i = 0; i < k; ++i)
        row += 1 + clusters["components"][i].get<std::size_t>();
    std::vector<double> sum;
    for (std::size_t c = 0; c < dimension; ++c) {
        sum.push_back(numberOfVector(row, c));
        for (std::size_t p = 1; p <= clusters["components"][k].get<std::size_t>(); ++p)
            sum.back() += numberOfVertex(p, true) * numberOfVector(row + p, c);
    }
    return sum;
}

TEST(AssetWithClusters, VectorsAndWeightsStandWhereTheFormatSays) {
    // expandLayer rounds to a float once, and its weights and vectors before.
    constexpr double kRounding = 3e-7;
    const Scene scene = makeTwoGrids();
    const std::vector<std::size_t> offsets = vertexOffsets(scene);
    for (const TransferEncoding weights : kEncodings)
        for (const TransferEncoding vectors : kEncodings) {
            const CompressedTransfer transfer = makeClusteredTransfer(
                scene, 3, {weights, vectors, {2, 0, 5, 1}}, {Transport::interreflected});
            GlbFile file = test::splitGlb(encodeAsset(scene, transfer, makeProvenance()));
            const std::vector<float> values = expandLayer(transfer.layers[0]);
            for (std::size_t mesh = 0; mesh < 2; ++mesh)
                for (std::size_t v = 0; v < scene.meshes[mesh].vertexCount(); ++v) {
                    const std::vector<double> expected = vectorByTheFormat(file, mesh, v, 27);
                    const std::size_t receiver = transfer.receiverOfVertex[offsets[mesh] + v];
                    for (std::size_t i = 0; i < 27; ++i)
                        ASSERT_NEAR(values[receiver * 27 + i], expected[i], kRounding);
                }
        }
}

// The example of docs/format.md, on which other readers are to be tried.
TEST(AssetWithClusters, TheFormatsExampleIsWhatThePageSays) {
    // The page has nine decimals.
    constexpr double kPrinted = 6e-10 + 1e-7;  // and floats about seven
    CompressedLayer layer;
    layer.bases = {{2, 0}, {.encoding = TransferEncoding::unorm8}};
    StoredTable& vectors = layer.bases->vectors;
    vectors.scale = {0.25f, 0.5f, 0.5f, 0.5f};
    vectors.bias = {0.0f, -0.25f, -0.25f, -0.25f};
    vectors.numbers = makeTable<std::uint8_t>(4, {100, 128, 200, 128, 51, 0, 102, 255,  //
                                                  255, 204, 0, 51, 153, 255, 128, 128});
    layer.table = {.encoding = TransferEncoding::unorm8};
    layer.table.numbers = makeTable<std::uint8_t>(3, {0, 255, 51, 1, 0, 0});
    const CompressedTransfer transfer{2, 2, {0, 1, 0}, {layer}};
    const std::vector<std::byte> bytes =
        encodeAsset(test::makeTriangle(), transfer, makeProvenance());
    GlbFile file = test::splitGlb(bytes);
    const nlohmann::json written = headerOf(file)["layers"][0];
    EXPECT_EQ(written, nlohmann::json::parse(R"({
        "transport": "shadowed", "channels": 1, "encoding": "clusters",
        "attributes": { "first": 0, "count": 1 },
        "clusters": { "weights": "unorm8", "components": [2, 0], "encoding": "unorm8",
                      "scale": [0.25, 0.5, 0.5, 0.5], "bias": [0.0, -0.25, -0.25, -0.25],
                      "accessor": 0, "checksum": "8b2875b3" },
        "checksum": "717296f4" })"));

    const std::vector<float> values = expandLayer(decodeAsset(bytes, "asset").transfer.layers[0]);
    const std::array<double, 8> expected = {0.198039216, -0.219019608, 0.042156863, 0.220980392,
                                            0.15,        0.25,         0.000980392, 0.000980392};
    const std::array<double, 4> light = {2.0, 0.5, 1.0, -1.0};
    std::array<double, 2> radiance = {0.0, 0.0};
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_NEAR(values[i], expected[i], kPrinted) << i;
        radiance[i / 4] += values[i] * light[i % 4];
    }
    EXPECT_NEAR(radiance[0], 0.107745098, 4 * kPrinted);
    EXPECT_NEAR(radiance[1], 0.425, 4 * kPrinted);
    const std::vector<float> rows = expandTable(vectors);
    const std::array<double, 4> lit = {0.337745098, -0.325, 0.475, 0.425};
    for (std::size_t row = 0; row < 4; ++row) {
        double sum = 0.0;
        for (std::size_t i = 0; i < 4; ++i)
            sum += rows[row * 4 + i] * light[i];
        EXPECT_NEAR(sum, lit[row], 4 * kPrinted) << row;
    }
}

}  // namespace
}  // namespace prt
