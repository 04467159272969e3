#include "prt/compress/choose_clusters.h"

#include <gtest/gtest.h>

#include <limits>

#include "prt/base/error.h"
#include "prt/compress/compress_transfer.h"
#include "prt/compress/compression_error.h"
#include "tests/support/sample_vectors.h"

namespace prt {
namespace {

constexpr int kBandCount = 4;

TransferLayer makeLayer(int channelCount, std::size_t receiverCount) {
    const std::size_t rowLength = coefficientsPerReceiver(kBandCount, channelCount);
    return {Transport::interreflected, channelCount,
            makeTable(rowLength, makeClouds({.count = receiverCount,
                                             .dimension = rowLength,
                                             .cloudCount = 15,
                                             .subspaceDimension = 4,
                                             .spread = 2.0,
                                             .noise = 0.05}))};
}

std::vector<Vec3d> makeLight() {
    std::vector<Vec3d> light = {{3.0, 2.0, 1.0}};
    light.resize(16, Vec3d(0.2, 0.1, 0.3));
    return light;
}

TEST(CompressToBudget, CountsAttributesAndBases) {
    // 7 numbers a row are two attributes of four; 5 vectors of 48 numbers are shared by 100.
    CompressedLayer layer{.channelCount = 3};
    layer.table = {.encoding = TransferEncoding::unorm8, .numbers = CoefficientTable(100, 7, 1)};
    EXPECT_EQ(countBytesPerReceiver(layer), 8.0);
    layer.bases.emplace();
    layer.bases->vectors = {.encoding = TransferEncoding::unorm16,
                            .numbers = CoefficientTable(5, 48, 2)};
    EXPECT_EQ(countBytesPerReceiver(layer), 8.0 + 5.0 * 48.0 * 2.0 / 100.0);
}

TEST(CompressToBudget, MoreBytesAreNeverExceededAndLowerTheError) {
    constexpr double kLuck = 1.05;  // of one clustering against another
    for (const int channelCount : {1, 3}) {
        const TransferLayer layer = makeLayer(channelCount, 600);
        double last = std::numeric_limits<double>::infinity();
        for (const double bytes : {8.0, 14.0, 20.0, 40.0, 200.0}) {
            const CompressedLayer stored = compressToBudget(layer, {}, {.bytesPerReceiver = bytes});
            EXPECT_EQ(stored.transport, Transport::interreflected);
            EXPECT_EQ(stored.channelCount, channelCount);
            EXPECT_LE(countBytesPerReceiver(stored), bytes);
            const double error = measureCompressionError(stored, layer).relativeRmse;
            EXPECT_LE(error, kLuck * last) << bytes;
            last = error;
        }
        EXPECT_LT(last, channelCount == 1 ? 1e-9 : 1e-4);
    }
}

TEST(CompressToBudget, AMaxErrorIsKeptByTheResultAndALargerOneTakesFewerBytes) {
    const TransferLayer layer = makeLayer(1, 600);
    for (const std::vector<Vec3d>& light : {std::vector<Vec3d>{}, makeLight()}) {
        ClusterOptions options;
        options.light = light;
        double last = std::numeric_limits<double>::infinity();
        for (const double maxError : {1e-7, 1e-3, 0.01, 0.05, 0.2}) {
            const CompressedLayer stored = compressToBudget(layer, options, {.maxError = maxError});
            const CompressionError error = measureCompressionError(stored, layer, light);
            EXPECT_LE(light.empty() ? error.relativeRmse : error.seen, maxError);
            EXPECT_LE(countBytesPerReceiver(stored), last);
            last = countBytesPerReceiver(stored);
        }
        EXPECT_LT(last, 20.0);
    }
}

TEST(CompressToBudget, ComponentsThatAreNotNeededAreLeftOut) {
    // Half of the clouds are a point and noise; the others need their four components.
    std::vector<float> rows = makeClouds({.count = 2000,
                                          .dimension = 16,
                                          .cloudCount = 10,
                                          .subspaceDimension = 4,
                                          .spread = 20.0,
                                          .noise = 0.05});
    const std::vector<float> points = makeClouds({.count = 2000,
                                                  .dimension = 16,
                                                  .cloudCount = 10,
                                                  .subspaceDimension = 0,
                                                  .spread = 20.0,
                                                  .noise = 0.05,
                                                  .seed = 2});
    rows.insert(rows.end(), points.begin(), points.end());
    const TransferLayer layer{Transport::shadowed, 1, makeTable(16, rows)};
    const CompressedLayer stored = compressToBudget(layer, {}, {.maxError = 0.01});
    ASSERT_TRUE(stored.bases);
    EXPECT_LT(stored.bases->vectors.numbers.rowCount(),
              stored.bases->clusterCount() * (1 + stored.bases->componentCount()));
}

TEST(CompressToBudget, FewReceiversAreStoredByColumns) {
    for (const std::size_t receiverCount : {1, 9}) {
        const TransferLayer layer = makeLayer(3, receiverCount);
        const CompressedLayer stored = compressToBudget(layer, {}, {.maxError = 1e-3});
        EXPECT_FALSE(stored.bases);
        EXPECT_LE(measureCompressionError(stored, layer).relativeRmse, 1e-3);
        EXPECT_LE(countBytesPerReceiver(compressToBudget(layer, {}, {.bytesPerReceiver = 100.0})),
                  100.0);
    }
}

TEST(CompressToBudget, TooFewBytesAreAnError) {
    try {
        compressToBudget(makeLayer(1, 100), {}, {.bytesPerReceiver = 3.9});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::invalidOption);
    }
}

TEST(CompressToBudget, ThreadsDoNotChangeAByte) {
    const TransferLayer layer = makeLayer(1, 600);
    for (const CompressionBudget& budget :
         {CompressionBudget{.bytesPerReceiver = 12.0}, CompressionBudget{.maxError = 0.02}}) {
        const CompressedLayer one = compressToBudget(layer, {}, budget, 1);
        const CompressedLayer three = compressToBudget(layer, {}, budget, 3);
        EXPECT_TRUE(one.table.numbers == three.table.numbers);
        EXPECT_EQ(one.bases.has_value(), three.bases.has_value());
        if (one.bases) {
            EXPECT_TRUE(one.bases->vectors.numbers == three.bases->vectors.numbers);
        }
    }
}

TEST(CompressToBudget, ACallerCanStopIt) {
    for (const std::string_view stage : {"choose", "cluster"}) {
        const ProgressCallback stopThere = [&](const Progress& progress) {
            return progress.stage != stage;
        };
        EXPECT_THROW(
            compressToBudget(makeLayer(1, 500), {}, {.bytesPerReceiver = 12.0}, 0, stopThere),
            Error);
    }
}

TEST(CompressToBudget, IsWhatCompressTransferDoesUnderABudget) {
    const TransferLayer layer = makeLayer(3, 500);
    TransferField field{kBandCount, 500, {}, {layer}};
    CompressOptions options;
    options.budget = {.bytesPerReceiver = 20.0};
    const CompressedTransfer stored = compressTransfer(field, options);
    EXPECT_TRUE(isComplete(stored, stored.layers.at(0)));
    EXPECT_TRUE(stored.layers[0].table.numbers ==
                compressToBudget(layer, {}, *options.budget).table.numbers);
}

}  // namespace
}  // namespace prt
