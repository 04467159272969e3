#include "prt/compress/compress_transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "prt/base/assert.h"

namespace prt {
namespace {

constexpr std::size_t kWidth = CoefficientTable::kPanelWidth;
// So many are converted at a time, between one panel and another.
constexpr std::size_t kRowsAtOnce = 4096;

/// A column's smallest value and how far the others go beyond it.
struct Range {
    float low = 0.0f;
    float size = 0.0f;
};

std::array<Range, kWidth> findRanges(std::span<const float> panel) {
    std::array<Range, kWidth> ranges = {};
    if (panel.empty()) return ranges;
    std::array<float, kWidth> low;
    std::copy_n(panel.begin(), kWidth, low.begin());
    std::array<float, kWidth> high = low;
    for (std::size_t row = 0; row < panel.size(); row += kWidth)
        for (std::size_t column = 0; column < kWidth; ++column) {
            low[column] = std::min(low[column], panel[row + column]);
            high[column] = std::max(high[column], panel[row + column]);
        }
    for (std::size_t column = 0; column < kWidth; ++column)
        ranges[column] = {low[column], high[column] - low[column]};
    return ranges;
}

/// Rounds each value to the nearest step of its column's range; in double, which keeps the error
/// within half a step.
template <class Integer>
void quantisePanel(std::span<const float> panel, const std::array<Range, kWidth>& ranges,
                   double maxInteger, std::size_t index, CoefficientTable& quantised) {
    std::array<double, kWidth> stepsPerUnit = {};
    for (std::size_t column = 0; column < kWidth; ++column)
        if (ranges[column].size > 0.0f) stepsPerUnit[column] = maxInteger / ranges[column].size;

    std::vector<Integer> rows;
    for (std::size_t begin = 0; begin < panel.size(); begin += rows.size()) {
        rows.resize(std::min(kRowsAtOnce * kWidth, panel.size() - begin));
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::size_t column = i % kWidth;
            const double aboveLow = static_cast<double>(panel[begin + i]) - ranges[column].low;
            const double steps = std::min(aboveLow * stepsPerUnit[column], maxInteger);
            rows[i] = static_cast<Integer>(steps + 0.5);
        }
        quantised.writePanel(index, begin / kWidth, std::as_bytes(std::span(rows)));
    }
}

template <class Integer>
void quantise(const CoefficientTable& coefficients, double maxInteger, CompressedLayer& layer) {
    for (std::size_t index = 0; index < coefficients.panelCount(); ++index) {
        const std::span<const float> panel = floatPanel(coefficients, index);
        const std::array<Range, kWidth> ranges = findRanges(panel);
        quantisePanel<Integer>(panel, ranges, maxInteger, index, layer.data);
        const std::size_t used = std::min(kWidth, coefficients.columnCount() - index * kWidth);
        for (std::size_t column = 0; column < used; ++column) {
            layer.bias.push_back(ranges[column].low);
            layer.scale.push_back(ranges[column].size);
        }
        coefficients.releaseMemory();
    }
}

bool isFinite(const CoefficientTable& coefficients) {
    for (std::size_t index = 0; index < coefficients.panelCount(); ++index) {
        const std::span<const float> panel = floatPanel(coefficients, index);
        if (!std::all_of(panel.begin(), panel.end(),
                         [](float value) { return std::isfinite(value); }))
            return false;
        coefficients.releaseMemory();
    }
    return true;
}

/// @param layer  given up, so that numbers that stay as they are need not be held twice
CompressedLayer compressLayer(TransferLayer layer, TransferEncoding encoding) {
    const CoefficientTable& coefficients = layer.coefficients;
    CompressedLayer compressed;
    compressed.transport = layer.transport;
    compressed.channelCount = layer.channelCount;
    compressed.encoding = encoding;
    if (encoding == TransferEncoding::float32) {
        compressed.data = std::move(layer.coefficients);
        return compressed;
    }
    compressed.data = CoefficientTable(coefficients.rowCount(), coefficients.columnCount(),
                                       bytesPerCoefficient(encoding), coefficients.storage());
    if (encoding == TransferEncoding::unorm16)
        quantise<std::uint16_t>(coefficients, 65535.0, compressed);
    else
        quantise<std::uint8_t>(coefficients, 255.0, compressed);
    return compressed;
}

}  // namespace

CompressedTransfer compressTransfer(TransferField field, const CompressOptions& options) {
    CompressedTransfer transfer;
    transfer.bandCount = field.bandCount;
    transfer.receiverCount = field.receiverCount;
    transfer.receiverOfVertex = std::move(field.receiverOfVertex);
    for (TransferLayer& layer : field.layers) {
        PRT_ASSERT(layer.coefficients.rowCount() == field.receiverCount &&
                       layer.coefficients.columnCount() ==
                           coefficientsPerReceiver(field.bandCount, layer.channelCount),
                   "the layer has all coefficients of all receivers");
        PRT_ASSERT(isFinite(layer.coefficients), "every coefficient is finite");
        transfer.layers.push_back(compressLayer(std::move(layer), options.encoding));
    }
    return transfer;
}

}  // namespace prt
