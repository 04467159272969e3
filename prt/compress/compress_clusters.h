#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/math/vector.h"
#include "prt/parallel/progress.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// How transfer is stored by clusters: many of them with a few components each is clustered PCA,
/// one is PCA, and clusters without components are vector quantisation.
struct ClusterOptions {
    std::size_t clusterCount = 64;
    std::size_t componentCount = 15;  ///< of a cluster; 3, 7, 11, … fill attributes of four
                                      ///< numbers, of which the cluster is one
    double maxError = 0.0;  ///< fewer components, if these keep this root mean square of the error,
                            ///< over that of the transfer, before weights are rounded; 0: all
    std::vector<Vec3d> light{};  ///< errors weigh as they are seen under this light turned at
                                 ///< random, lightErrorWeights; empty: all alike
    TransferEncoding basesEncoding = TransferEncoding::unorm16;
    std::size_t iterationCount = 20;
    std::size_t trainingCount = 0;  ///< so many receivers, spread over all, find the clusters; 0:
                                    ///< all, or what fits in 2²⁷ numbers
    std::uint64_t seed = 1;
};

/// Rows of numbers as they are stored by clusters; see CompressedLayer.
struct ClusteredTable {
    StoredTable table;
    ClusterBases bases;
};

/// The most clusters that a cluster's number of this encoding can tell apart.
std::size_t largestClusterCount(TransferEncoding encoding);

/// Finds clusters and their components (computeClusteredPca, or computeKMeans where there are no
/// components), and stores each row by the cluster that reproduces it best.
///
/// The components get the length of the range of their weights, and are rounded first; then each
/// row's weights are those that are best for the bases as they are stored, so that their rounding
/// costs next to nothing. Clusters and components that no row needs are left out.
///
/// The same seed gives the same bits for any number of threads (C10).
///
/// @param numbers         finite floats, at least one row; read in a few passes, so that it may
///                        lie on disk
/// @param errorWeights    as VectorSet has them
/// @param weightEncoding  of the cluster and the weights of a row
/// @param threadCount     0: one a core
/// @param progress        stages "quantise", "cluster" and "encode"
/// @throws Error          invalidOption for more clusters than weightEncoding can number, cancelled
ClusteredTable compressClusters(const CoefficientTable& numbers,
                                std::span<const float> errorWeights, const ClusterOptions& options,
                                TransferEncoding weightEncoding, int threadCount = 0,
                                const ProgressCallback& progress = {});

}  // namespace prt
