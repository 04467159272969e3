#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "prt/transfer/coefficient_table.h"

namespace prt {

/// How much of light transport a transfer vector holds; each includes the one before.
enum class Transport {
    unshadowed,      ///< the cosine alone
    shadowed,        ///< and visibility
    interreflected,  ///< and diffuse bounces, coloured by the other surfaces
};

std::string_view transportName(Transport transport);
std::optional<Transport> parseTransport(std::string_view name);

/// Transfer vectors of one kind for every receiver.
///
///   T_i(x) = (1/π) ∫ V(x, ω) max(⟨n, ω⟩, 0) y_i(ω) dω + bounces   [Sloan02, 7; Dachsbacher17]
///
/// The receiver's own albedo is outside, every other surface's is inside (C6), so outgoing radiance
/// is albedo(x) Σ_i T_i L_i (C7).
struct TransferLayer {
    Transport transport = Transport::shadowed;
    int channelCount = 1;           ///< 1: the same for red, green and blue; 3: coloured by bounces
    CoefficientTable coefficients;  ///< of floats: a row is [channel][coefficient]
};

/// What a bake makes: the transfer of a scene's receivers.
struct TransferField {
    int bandCount = 0;
    std::size_t receiverCount = 0;
    std::vector<std::uint32_t>
        receiverOfVertex;               ///< one a vertex of the scene, numbered mesh after mesh
    std::vector<TransferLayer> layers;  ///< at most one of each kind, ascending

    /// The layer of this kind, or null.
    const TransferLayer* findLayer(Transport transport) const;
};

/// How many numbers a layer holds for one receiver: n² for each channel.
std::size_t coefficientsPerReceiver(int bandCount, int channelCount);

/// The n² coefficients of one receiver and channel.
std::vector<float> transferVector(const TransferField& field, const TransferLayer& layer,
                                  std::size_t receiver, int channel);

}  // namespace prt
