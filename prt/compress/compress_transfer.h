#pragma once

#include <optional>

#include "prt/compress/choose_clusters.h"
#include "prt/compress/compress_clusters.h"
#include "prt/parallel/progress.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

struct CompressOptions {
    TransferEncoding encoding = TransferEncoding::unorm16;  ///< of a coefficient; with clusters, of
                                                            ///< a receiver's cluster and weights
    std::optional<ClusterOptions> clusters{};
    std::optional<CompressionBudget> budget{};  ///< of each layer: chooses the encoding, and how
                                                ///< many clusters and components, in their place
    int threadCount = 0;                        ///< 0: one a core
    ProgressCallback progress{};                ///< as compressClusters, and compressToBudget
};

/// Stores each layer in fewer bits: its columns as quantiseTable does, or, with clusters, its rows
/// as compressClusters does, or under a budget compressToBudget. A layer without receivers has no
/// clusters.
///
/// @param field   its layers go as they are compressed: whoever needs it still passes a copy
/// @throws Error  as compressClusters and compressToBudget
CompressedTransfer compressTransfer(TransferField field, const CompressOptions& options = {});

/// The same of one layer, which stays.
CompressedLayer compressLayer(const TransferLayer& layer, int bandCount,
                              const CompressOptions& options = {});

}  // namespace prt
