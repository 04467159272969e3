#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "prt/transfer/stored_table.h"
#include "prt/transfer/transfer_field.h"

namespace prt {

/// What the receivers of a cluster have in common: vectors, of which transfer vectors are sums.
///
///   T(x) = b_k0 + Σ_p w_p(x) b_kp        k the cluster of x, p ≥ 1, 0 ≤ w_p ≤ 1      [Sloan03]
///
/// One cluster for all is PCA; clusters with b_k0 alone are vector quantisation.
///
/// Differs from the paper: b_k0 is the mean moved to where the weights begin, and a component has
/// the length of their range, so that weights are fractions without a scale of their own.
struct ClusterBases {
    std::vector<std::uint32_t> componentCounts{};  ///< of each cluster, beyond b_k0
    StoredTable vectors{};  ///< b_k0, b_k1, … of the first cluster, then those of the next; a row
                            ///< is that of a receiver

    std::size_t clusterCount() const { return componentCounts.size(); }
    /// The most that a cluster has.
    std::size_t componentCount() const;
    /// The rows of b_k0 for each k, and behind them the count of all.
    std::vector<std::size_t> firstVectors() const;
};

/// A TransferLayer as it is stored.
struct CompressedLayer {
    Transport transport = Transport::shadowed;
    int channelCount = 1;
    /// A row a receiver: that of the TransferLayer; or, with clusters, k as it is and the
    /// fractions w_1, w_2, …, without scale and bias, as many as bases.componentCount() and 0
    /// beyond those of k.
    StoredTable table{};
    std::optional<ClusterBases> bases{};  ///< of a layer with clusters
    float largestError = 0.0f;  ///< how far a coefficient may be from what was baked, where that is
                                ///< more than the rounding of `table`
    int incidentBandCount = 0;  ///< as that of the TransferLayer
};

std::size_t coefficientsPerReceiver(int bandCount, const CompressedLayer& layer);

/// A TransferField as it is stored.
struct CompressedTransfer {
    int bandCount = 0;
    std::size_t receiverCount = 0;
    std::vector<std::uint32_t> receiverOfVertex;
    std::vector<CompressedLayer> layers;

    const CompressedLayer* findLayer(Transport transport) const;
};

/// What a layer stores for one receiver: its coefficients, or its cluster and weights.
std::size_t bytesPerReceiver(const CompressedLayer& layer);

/// What a layer stores for all receivers together: the bases of its clusters.
std::size_t countSharedBytes(const CompressedLayer& layer);

/// The part of these that falls to one receiver; 0 if there is none.
double sharedBytesPerReceiver(const CompressedLayer& layer);

/// Whether a layer has all coefficients of all receivers, stored as it says.
bool isComplete(const CompressedTransfer& transfer, const CompressedLayer& layer);

/// The clusters of receivers [firstReceiver, firstReceiver + clusters.size()) of a layer that has
/// some. @param clusters  written
void readClusters(const CompressedLayer& layer, std::size_t firstReceiver,
                  std::span<std::uint32_t> clusters);

/// Decodes receivers of a layer, some at a time; what they have in common is decoded once.
class LayerDecoder {
  public:
    /// @param layer  must outlive this
    explicit LayerDecoder(const CompressedLayer& layer);

    /// Floats, [receiver][channel][coefficient].
    std::vector<float> expand(std::size_t firstReceiver, std::size_t receiverCount) const;

  private:
    std::vector<float> expandClusters(std::size_t firstReceiver, std::size_t receiverCount) const;

    const CompressedLayer& layer_;
    std::vector<float> vectors_{};             // of the bases
    std::vector<std::size_t> firstVectors_{};  // of the bases
};

/// Decodes all receivers.
std::vector<float> expandLayer(const CompressedLayer& layer);

/// Decodes all layers.
TransferField expandTransfer(const CompressedTransfer& transfer);

}  // namespace prt
