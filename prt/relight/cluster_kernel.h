#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "prt/relight/relight_kernel.h"

namespace prt {

/// Receivers that are relit one part after the other, so that results in any sequence stay in the
/// core's own cache until they are written.
inline constexpr std::size_t kClusterPartSize = 4096;

/// While a part is relit its radiance is staged in rows of as many floats, the last unused.
inline constexpr std::size_t kStagedRowSize = 4;

/// Two parts, of which one is relit while the other is written, and what vectors read behind them.
inline constexpr std::size_t kStagedFloats = (2 * kClusterPartSize + 8) * kStagedRowSize;

/// Receivers of a part that are relit in the same way.
struct ClusteredReceivers {
    std::span<const std::uint32_t> clusters{};  ///< of each block, or of each single receiver
    const std::uint16_t* stagedAt = nullptr;    ///< where each receiver's row is staged
    const std::byte* weights = nullptr;  ///< of each as many as its cluster has components: for a
                                         ///< block [component][16 lanes], aligned to 64 bytes
};

/// Up to 4096 receivers in the sequence of their clusters.
struct ClusterPart {
    ClusteredReceivers blocks{};   ///< sixteen of one cluster; a lane may repeat another
    ClusteredReceivers singles{};  ///< those that are too few of a cluster for a block
};

/// What the light makes of the clusters' vectors: R_k0, and for each component R_kp over the stored
/// number that stands for 1. An unused one is at the end.
struct ClusterRadiance {
    std::span<const std::uint32_t> firstVectors{};  ///< of each k, and behind them of none
    const Vec3f* products = nullptr;
};

/// Writes R_k0 + Σ_p w_p R_kp for `receiverCount` receivers from the first part on, summed in the
/// same way for every receiver of a cluster.
///
/// @param staged  kStagedFloats for the kernel's own use, aligned to 64 bytes
void relightClusters(TransferEncoding encoding, std::span<const ClusterPart> parts,
                     const ClusterRadiance& clusters, std::size_t receiverCount, ResultStore store,
                     float* staged, Vec3f* radiance);

}  // namespace prt
