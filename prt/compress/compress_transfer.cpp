#include "prt/compress/compress_transfer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "prt/base/assert.h"

namespace prt {
namespace {

/// Finds each column's smallest value and its range: the layer's bias and scale.
void findRanges(std::span<const float> values, std::size_t rowLength, CompressedLayer& layer) {
    layer.bias.assign(rowLength, 0.0f);
    layer.scale.assign(rowLength, 0.0f);
    if (values.empty()) return;

    std::vector<float> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rowLength));
    std::vector<float> high = low;
    for (std::size_t row = 0; row < values.size(); row += rowLength) {
        for (std::size_t column = 0; column < rowLength; ++column) {
            low[column] = std::min(low[column], values[row + column]);
            high[column] = std::max(high[column], values[row + column]);
        }
    }
    for (std::size_t column = 0; column < rowLength; ++column) {
        layer.bias[column] = low[column];
        layer.scale[column] = high[column] - low[column];
    }
}

/// Rounds each value to the nearest step of its column's range; in double, which keeps the error
/// within half a step.
template <class Integer>
void quantise(std::span<const float> values, std::size_t rowLength, double maxInteger,
              CompressedLayer& layer) {
    findRanges(values, rowLength, layer);
    std::vector<double> stepsPerUnit(rowLength, 0.0);
    for (std::size_t column = 0; column < rowLength; ++column)
        if (layer.scale[column] > 0.0f) stepsPerUnit[column] = maxInteger / layer.scale[column];

    layer.data.resize(values.size() * sizeof(Integer));
    std::byte* destination = layer.data.data();
    for (std::size_t row = 0; row < values.size(); row += rowLength) {
        for (std::size_t column = 0; column < rowLength; ++column, destination += sizeof(Integer)) {
            const double aboveLow = static_cast<double>(values[row + column]) - layer.bias[column];
            const double steps = std::min(aboveLow * stepsPerUnit[column], maxInteger);
            const auto integer = static_cast<Integer>(steps + 0.5);
            std::memcpy(destination, &integer, sizeof(Integer));
        }
    }
}

CompressedLayer compressLayer(const TransferLayer& layer, std::size_t rowLength,
                              TransferEncoding encoding) {
    CompressedLayer compressed;
    compressed.transport = layer.transport;
    compressed.channelCount = layer.channelCount;
    compressed.encoding = encoding;
    const std::span<const float> values = layer.coefficients;
    switch (encoding) {
        case TransferEncoding::float32: {
            const std::span<const std::byte> bytes = std::as_bytes(values);
            compressed.data.assign(bytes.begin(), bytes.end());
            break;
        }
        case TransferEncoding::unorm16:
            quantise<std::uint16_t>(values, rowLength, 65535.0, compressed);
            break;
        case TransferEncoding::unorm8:
            quantise<std::uint8_t>(values, rowLength, 255.0, compressed);
            break;
    }
    return compressed;
}

}  // namespace

CompressedTransfer compressTransfer(const TransferField& field, const CompressOptions& options) {
    CompressedTransfer transfer;
    transfer.bandCount = field.bandCount;
    transfer.receiverCount = field.receiverCount;
    transfer.receiverOfVertex = field.receiverOfVertex;
    for (const TransferLayer& layer : field.layers) {
        const std::size_t rowLength = coefficientsPerReceiver(field.bandCount, layer.channelCount);
        PRT_ASSERT(layer.coefficients.size() == field.receiverCount * rowLength,
                   "the layer has all coefficients of all receivers");
        PRT_ASSERT(std::all_of(layer.coefficients.begin(), layer.coefficients.end(),
                               [](float value) { return std::isfinite(value); }),
                   "every coefficient is finite");
        transfer.layers.push_back(compressLayer(layer, rowLength, options.encoding));
    }
    return transfer;
}

}  // namespace prt
