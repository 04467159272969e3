#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "prt/transfer/coefficient_table.h"

namespace prt {

/// How much of light transport a layer holds: vectors, of what a diffuse receiver reflects, or
/// matrices, of what comes in at a receiver of any material.
enum class Transport {
    unshadowed,      ///< vectors: the cosine alone
    shadowed,        ///< and visibility
    interreflected,  ///< and diffuse bounces, coloured by the other surfaces
    glossyShadowed,  ///< matrices: visibility alone
    glossy,          ///< and bounces off the materials as they are
};

/// Whether the layer is of matrices.
bool isGlossy(Transport transport);

std::string_view transportName(Transport transport);
std::optional<Transport> parseTransport(std::string_view name);

/// Transfer vectors of one kind for every receiver.
///
///   T_i(x) = (1/π) ∫ V(x, ω) max(⟨n, ω⟩, 0) y_i(ω) dω + bounces   [Sloan02, 7; Dachsbacher17]
///
/// The receiver's own albedo is outside, every other surface's is inside (C6), so outgoing radiance
/// is albedo(x) Σ_i T_i L_i (C7).
///
/// Or transfer matrices, from light to incident radiance in the receiver's frame R_x
/// (frameFromNormal, normal = +z), nothing coming in from below:
///
///   M_ij(x) = ∫ y_i(R_x ω) V(x, ω) y_j(ω) dω + bounces                               [Sloan02, 5]
struct TransferLayer {
    Transport transport = Transport::shadowed;
    int channelCount = 1;           ///< 1: the same for red, green and blue; 3: coloured by bounces
    CoefficientTable coefficients;  ///< of floats: a row is [channel][j], or [channel][i][j]
    int incidentBandCount = 0;      ///< of matrices, i < n_in²; 0 of vectors
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

/// How many numbers a layer holds for one receiver: n² for each channel, and of matrices so many
/// for each of n_in² rows.
std::size_t coefficientsPerReceiver(int bandCount, int channelCount, int incidentBandCount = 0);
std::size_t coefficientsPerReceiver(int bandCount, const TransferLayer& layer);

/// The n² coefficients of one receiver and channel of a layer of vectors.
std::vector<float> transferVector(const TransferField& field, const TransferLayer& layer,
                                  std::size_t receiver, int channel);

}  // namespace prt
