#include "prt/transfer/compressed_transfer.h"

#include <algorithm>
#include <array>
#include <cstring>
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
void expandIntegers(const CompressedLayer& layer, double maxInteger, std::span<float> values) {
    const std::size_t rowLength = layer.scale.size();
    const std::byte* source = layer.data.data();
    for (std::size_t row = 0; row < values.size(); row += rowLength) {
        for (std::size_t column = 0; column < rowLength; ++column, source += sizeof(Integer)) {
            Integer integer = 0;
            std::memcpy(&integer, source, sizeof(Integer));
            const double fraction = static_cast<double>(integer) / maxInteger;
            values[row + column] =
                static_cast<float>(layer.bias[column] + layer.scale[column] * fraction);
        }
    }
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

std::vector<float> expandLayer(const CompressedTransfer& transfer, const CompressedLayer& layer) {
    const std::size_t rowLength = coefficientsPerReceiver(transfer.bandCount, layer.channelCount);
    std::vector<float> values(transfer.receiverCount * rowLength);
    PRT_ASSERT(layer.data.size() == values.size() * bytesPerCoefficient(layer.encoding),
               "the layer has all coefficients of all receivers");
    if (layer.encoding == TransferEncoding::float32) {
        if (!values.empty()) std::memcpy(values.data(), layer.data.data(), layer.data.size());
        return values;
    }

    PRT_ASSERT(layer.scale.size() == rowLength && layer.bias.size() == rowLength,
               "each channel and coefficient has a scale and a bias");
    if (layer.encoding == TransferEncoding::unorm16)
        expandIntegers<std::uint16_t>(layer, 65535.0, values);
    else
        expandIntegers<std::uint8_t>(layer, 255.0, values);
    return values;
}

}  // namespace prt
