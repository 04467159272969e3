#include "prt/transfer/compressed_transfer.h"

#include <algorithm>
#include <array>
#include <span>

#include "prt/base/assert.h"

namespace prt {
namespace {

/// In the order of the enumeration.
constexpr std::array<std::string_view, 3> kEncodingNames = {"float32", "unorm16", "unorm8"};
constexpr std::array<std::size_t, 3> kEncodingBytes = {4, 2, 1};

/// Decodes the integers of every receiver; in double, so that each result is the
/// float nearest to what is meant.
template <class Integer>
std::vector<float> expandIntegers(const CompressedLayer& layer, double maxInteger) {
    const std::size_t rowLength = layer.data.columnCount();
    PRT_ASSERT(layer.scale.size() == rowLength && layer.bias.size() == rowLength,
               "each channel and coefficient has a scale and a bias");
    std::vector<float> values;
    values.reserve(layer.data.rowCount() * rowLength);
    std::vector<Integer> row(rowLength);
    for (std::size_t receiver = 0; receiver < layer.data.rowCount(); ++receiver) {
        layer.data.readRow(receiver, std::span(row));
        for (std::size_t column = 0; column < rowLength; ++column) {
            const double fraction = static_cast<double>(row[column]) / maxInteger;
            values.push_back(
                static_cast<float>(layer.bias[column] + layer.scale[column] * fraction));
        }
    }
    return values;
}

}  // namespace

std::string_view encodingName(TransferEncoding encoding) {
    return kEncodingNames[static_cast<std::size_t>(encoding)];
}

std::optional<TransferEncoding> parseEncoding(std::string_view name) {
    const auto found = std::find(kEncodingNames.begin(), kEncodingNames.end(), name);
    if (found == kEncodingNames.end()) return std::nullopt;
    return static_cast<TransferEncoding>(found - kEncodingNames.begin());
}

std::size_t bytesPerCoefficient(TransferEncoding encoding) {
    return kEncodingBytes[static_cast<std::size_t>(encoding)];
}

const CompressedLayer* CompressedTransfer::findLayer(Transport transport) const {
    const auto found = std::find_if(
        layers.begin(), layers.end(),
        [transport](const CompressedLayer& layer) { return layer.transport == transport; });
    return found == layers.end() ? nullptr : &*found;
}

std::size_t bytesPerReceiver(const CompressedLayer& layer) {
    return layer.data.columnCount() * layer.data.elementBytes();
}

bool isComplete(const CompressedTransfer& transfer, const CompressedLayer& layer) {
    return layer.data.rowCount() == transfer.receiverCount &&
           layer.data.columnCount() ==
               coefficientsPerReceiver(transfer.bandCount, layer.channelCount) &&
           layer.data.elementBytes() == bytesPerCoefficient(layer.encoding);
}

std::vector<float> expandLayer(const CompressedLayer& layer) {
    PRT_ASSERT(layer.data.elementBytes() == bytesPerCoefficient(layer.encoding),
               "the numbers are stored as the layer says");
    switch (layer.encoding) {
        case TransferEncoding::unorm16:
            return expandIntegers<std::uint16_t>(layer, 65535.0);
        case TransferEncoding::unorm8:
            return expandIntegers<std::uint8_t>(layer, 255.0);
        case TransferEncoding::float32:
            break;
    }
    return copyRows<float>(layer.data);
}

TransferField expandTransfer(const CompressedTransfer& transfer) {
    TransferField field;
    field.bandCount = transfer.bandCount;
    field.receiverCount = transfer.receiverCount;
    field.receiverOfVertex = transfer.receiverOfVertex;
    for (const CompressedLayer& layer : transfer.layers)
        field.layers.push_back({layer.transport, layer.channelCount,
                                makeTable(layer.data.columnCount(), expandLayer(layer))});
    return field;
}

}  // namespace prt
