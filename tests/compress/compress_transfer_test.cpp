#include "prt/compress/compress_transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "prt/base/random.h"
#include "prt/compress/compression_error.h"

namespace prt {
namespace {

// Expanding rounds to a float once, and a range is a rounded difference: each at most this share of
// the largest number.
constexpr double kRounding = 1.5 * std::numeric_limits<float>::epsilon();

constexpr std::size_t kReceiverCount = 501;
constexpr int kBandCount = 5;

/// Random transfer whose columns have very different ranges, as bands have.
TransferField randomField() {
    TransferField field;
    field.bandCount = kBandCount;
    field.receiverCount = kReceiverCount;
    field.receiverOfVertex = {2, 0, 500};
    RandomStream random(1, 2);
    for (const int channelCount : {1, 3}) {
        TransferLayer layer;
        layer.transport = channelCount == 1 ? Transport::shadowed : Transport::interreflected;
        layer.channelCount = channelCount;
        const std::size_t rowLength = coefficientsPerReceiver(kBandCount, channelCount);
        std::vector<float> values(kReceiverCount * rowLength);
        for (std::size_t i = 0; i < values.size(); ++i) {
            const float range = std::exp2(-static_cast<float>(i % rowLength));
            values[i] = range * (random.nextUnitFloat() - 0.3f);
        }
        layer.coefficients = makeTable(rowLength, values);
        field.layers.push_back(layer);
    }
    return field;
}

struct Column {
    double low = 0.0;
    double high = 0.0;
};

Column columnOf(const std::vector<float>& values, std::size_t rowLength, std::size_t column) {
    Column range{values[column], values[column]};
    for (std::size_t i = column; i < values.size(); i += rowLength) {
        range.low = std::min<double>(range.low, values[i]);
        range.high = std::max<double>(range.high, values[i]);
    }
    return range;
}

// T-21: the error is at most the coefficient's own range / 510 for 8 bits, / 131070 for 16.
void expectErrorsWithinHalfAStep(TransferEncoding encoding, double halfStepsPerRange) {
    const TransferField field = randomField();
    const CompressedTransfer compressed = compressTransfer(field, {encoding});
    ASSERT_EQ(compressed.layers.size(), field.layers.size());
    for (std::size_t l = 0; l < field.layers.size(); ++l) {
        const TransferLayer& layer = field.layers[l];
        const std::size_t rowLength = coefficientsPerReceiver(kBandCount, layer.channelCount);
        const std::vector<float> values = copyRows<float>(layer.coefficients);
        const std::vector<float> expanded = expandLayer(compressed.layers[l]);
        ASSERT_EQ(expanded.size(), values.size());
        for (std::size_t column = 0; column < rowLength; ++column) {
            const Column range = columnOf(values, rowLength, column);
            const double bound = (range.high - range.low) / halfStepsPerRange +
                                 kRounding * std::max(std::abs(range.low), std::abs(range.high));
            for (std::size_t i = column; i < expanded.size(); i += rowLength)
                ASSERT_NEAR(expanded[i], values[i], bound) << "coefficient " << column;
        }
    }
}

TEST(CompressTransfer, WordsAreWithinHalfAStepOfTheField) {
    expectErrorsWithinHalfAStep(TransferEncoding::unorm16, 131070.0);
}

TEST(CompressTransfer, BytesAreWithinHalfAStepOfTheField) {
    expectErrorsWithinHalfAStep(TransferEncoding::unorm8, 510.0);
}

TEST(CompressTransfer, FloatsStayAsTheyAre) {
    const TransferField field = randomField();
    const CompressedTransfer compressed = compressTransfer(field, {TransferEncoding::float32});
    for (std::size_t l = 0; l < field.layers.size(); ++l) {
        EXPECT_TRUE(compressed.layers[l].table.numbers == field.layers[l].coefficients);
        EXPECT_TRUE(compressed.layers[l].table.scale.empty() &&
                    compressed.layers[l].table.bias.empty());
    }
}

TEST(CompressTransfer, AllButTheNumbersIsKept) {
    const TransferField field = randomField();
    const CompressedTransfer compressed = compressTransfer(field);
    EXPECT_EQ(compressed.bandCount, field.bandCount);
    EXPECT_EQ(compressed.receiverCount, field.receiverCount);
    EXPECT_EQ(compressed.receiverOfVertex, field.receiverOfVertex);
    for (std::size_t l = 0; l < field.layers.size(); ++l) {
        EXPECT_EQ(compressed.layers[l].transport, field.layers[l].transport);
        EXPECT_EQ(compressed.layers[l].channelCount, field.layers[l].channelCount);
        EXPECT_EQ(compressed.layers[l].table.encoding, TransferEncoding::unorm16);
        EXPECT_EQ(2 * compressed.layers[l].table.numbers.byteCount(),
                  field.layers[l].coefficients.byteCount());
    }
}

TEST(CompressTransfer, AConstantCoefficientAndTheEndsOfARangeAreExact) {
    for (const TransferEncoding encoding : {TransferEncoding::unorm16, TransferEncoding::unorm8}) {
        TransferField field = randomField();
        const std::size_t rowLength = coefficientsPerReceiver(kBandCount, 1);
        std::vector<float> values = copyRows<float>(field.layers[0].coefficients);
        for (std::size_t row = 0; row < kReceiverCount; ++row) {
            values[row * rowLength] = 0.28209479f;
            values[row * rowLength + 1] = row % 2 == 0 ? 0.0f : 0.1f;
        }
        field.layers[0].coefficients = makeTable(rowLength, values);
        const CompressedTransfer compressed = compressTransfer(field, {encoding});
        const std::vector<float> expanded = expandLayer(compressed.layers[0]);
        for (std::size_t row = 0; row < kReceiverCount; ++row) {
            ASSERT_EQ(expanded[row * rowLength], 0.28209479f);
            ASSERT_EQ(expanded[row * rowLength + 1], row % 2 == 0 ? 0.0f : 0.1f);
        }
        EXPECT_EQ(compressed.layers[0].table.scale[0], 0.0f);
    }
}

TEST(CompressTransfer, AFieldWithoutReceiversIsEmpty) {
    TransferField field;
    field.bandCount = 3;
    field.layers = {{Transport::unshadowed, 1, CoefficientTable(0, 9, sizeof(float))}};
    for (const TransferEncoding encoding :
         {TransferEncoding::float32, TransferEncoding::unorm16, TransferEncoding::unorm8}) {
        const CompressedTransfer compressed = compressTransfer(field, {encoding});
        EXPECT_EQ(compressed.layers[0].table.numbers.rowCount(), 0u);
        EXPECT_TRUE(expandLayer(compressed.layers[0]).empty());
    }
}

TEST(ExpandTransfer, FloatsComeBackAsTheyWere) {
    const TransferField field = randomField();
    const TransferField back =
        expandTransfer(compressTransfer(field, {.encoding = TransferEncoding::float32}));
    EXPECT_EQ(back.bandCount, field.bandCount);
    EXPECT_EQ(back.receiverOfVertex, field.receiverOfVertex);
    ASSERT_EQ(back.layers.size(), field.layers.size());
    for (std::size_t i = 0; i < field.layers.size(); ++i) {
        EXPECT_EQ(back.layers[i].transport, field.layers[i].transport);
        EXPECT_EQ(back.layers[i].channelCount, field.layers[i].channelCount);
        EXPECT_TRUE(back.layers[i].coefficients == field.layers[i].coefficients);
    }
}

TEST(CompressionError, IsThatOfTheNumbersReadBack) {
    const TransferField field = randomField();
    const CompressedTransfer original =
        compressTransfer(field, {.encoding = TransferEncoding::float32});
    const CompressedTransfer bytes =
        compressTransfer(field, {.encoding = TransferEncoding::unorm8});
    for (std::size_t layer = 0; layer < field.layers.size(); ++layer) {
        const std::vector<float> truth = copyRows<float>(field.layers[layer].coefficients);
        const std::vector<float> stored = expandLayer(bytes.layers[layer]);
        double squares = 0.0, truthSquares = 0.0, largest = 0.0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            squares += std::pow(double(stored[i]) - double(truth[i]), 2.0);
            truthSquares += std::pow(double(truth[i]), 2.0);
            largest = std::max(largest, std::abs(double(stored[i]) - double(truth[i])));
        }
        const CompressionError error =
            measureCompressionError(bytes.layers[layer], original.layers[layer]);
        EXPECT_NEAR(error.rmse, std::sqrt(squares / double(truth.size())), 1e-12);
        EXPECT_NEAR(error.relativeRmse, std::sqrt(squares / truthSquares), 1e-12);
        EXPECT_EQ(error.largest, largest);
        EXPECT_GT(error.rmse, 0.0);
        const CompressionError none =
            measureCompressionError(original.layers[layer], original.layers[layer]);
        EXPECT_EQ(none.rmse, 0.0);
        EXPECT_EQ(none.largest, 0.0);
    }
}

}  // namespace
}  // namespace prt
