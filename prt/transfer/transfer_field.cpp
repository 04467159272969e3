#include "prt/transfer/transfer_field.h"

#include <algorithm>
#include <array>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"

namespace prt {
namespace {

/// In the order of the enumeration.
constexpr std::array<std::string_view, 5> kTransportNames = {
    "unshadowed", "shadowed", "interreflected", "glossy-shadowed", "glossy"};

}  // namespace

std::string_view transportName(Transport transport) {
    return kTransportNames[static_cast<std::size_t>(transport)];
}

std::optional<Transport> parseTransport(std::string_view name) {
    const auto found = std::find(kTransportNames.begin(), kTransportNames.end(), name);
    if (found == kTransportNames.end()) return std::nullopt;
    return static_cast<Transport>(found - kTransportNames.begin());
}

bool isGlossy(Transport transport) {
    return transport >= Transport::glossyShadowed;
}

const TransferLayer* TransferField::findLayer(Transport transport) const {
    const auto found = std::find_if(
        layers.begin(), layers.end(),
        [transport](const TransferLayer& layer) { return layer.transport == transport; });
    return found == layers.end() ? nullptr : &*found;
}

std::size_t coefficientsPerReceiver(int bandCount, int channelCount, int incidentBandCount) {
    const int rowCount = incidentBandCount == 0 ? 1 : shCoefficientCount(incidentBandCount);
    return static_cast<std::size_t>(channelCount) * static_cast<std::size_t>(rowCount) *
           static_cast<std::size_t>(shCoefficientCount(bandCount));
}

std::size_t coefficientsPerReceiver(int bandCount, const TransferLayer& layer) {
    return coefficientsPerReceiver(bandCount, layer.channelCount, layer.incidentBandCount);
}

std::vector<float> transferVector(const TransferField& field, const TransferLayer& layer,
                                  std::size_t receiver, int channel) {
    PRT_ASSERT(receiver < field.receiverCount, "the receiver is one of the field");
    PRT_ASSERT(!isGlossy(layer.transport), "a layer of vectors");
    PRT_ASSERT(channel >= 0 && channel < layer.channelCount, "the channel is one of the layer");
    std::vector<float> row(layer.coefficients.columnCount());
    layer.coefficients.readRow(receiver, std::span(row));
    const auto begin = row.begin() + static_cast<std::ptrdiff_t>(
                                         coefficientsPerReceiver(field.bandCount, channel));
    return {begin,
            begin + static_cast<std::ptrdiff_t>(coefficientsPerReceiver(field.bandCount, 1))};
}

}  // namespace prt
