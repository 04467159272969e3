#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "prt/transfer/transfer_field.h"

namespace prt {

/// How one coefficient is stored.
enum class TransferEncoding {
    float32,
    unorm16,  ///< value = bias + scale · q/65535, with a scale and bias per channel and coefficient
              ///< [Kautz04]
    unorm8,  ///< value = bias + scale · q/255
};

std::string_view encodingName(TransferEncoding encoding);
std::optional<TransferEncoding> parseEncoding(std::string_view name);
std::size_t bytesPerCoefficient(TransferEncoding encoding);

/// A TransferLayer as it is stored.
struct CompressedLayer {
    Transport transport = Transport::shadowed;
    int channelCount = 1;
    TransferEncoding encoding = TransferEncoding::float32;
    std::vector<float> scale{};  ///< [channel][coefficient]; empty for float32
    std::vector<float> bias{};   ///< [channel][coefficient]; empty for float32
    CoefficientTable data{};     ///< of the stored numbers: a row is [channel][coefficient]
};

/// A TransferField as it is stored.
struct CompressedTransfer {
    int bandCount = 0;
    std::size_t receiverCount = 0;
    std::vector<std::uint32_t> receiverOfVertex;
    std::vector<CompressedLayer> layers;

    const CompressedLayer* findLayer(Transport transport) const;
};

/// What a layer stores for one receiver.
std::size_t bytesPerReceiver(const CompressedLayer& layer);

/// Whether a layer has all coefficients of all receivers, stored as it says.
bool isComplete(const CompressedTransfer& transfer, const CompressedLayer& layer);

/// Decodes a layer to floats, [receiver][channel][coefficient].
std::vector<float> expandLayer(const CompressedLayer& layer);

/// Decodes all layers.
TransferField expandTransfer(const CompressedTransfer& transfer);

}  // namespace prt
