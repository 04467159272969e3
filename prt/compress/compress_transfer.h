#pragma once

#include <optional>

#include "prt/compress/compress_clusters.h"
#include "prt/parallel/progress.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

struct CompressOptions {
    TransferEncoding encoding = TransferEncoding::unorm16;  ///< of a coefficient; with clusters, of
                                                            ///< a receiver's cluster and weights
    std::optional<ClusterOptions> clusters{};
    int threadCount = 0;          ///< 0: one a core
    ProgressCallback progress{};  ///< as compressClusters
};

/// Stores each layer in fewer bits: its columns as quantiseTable does, or, with clusters, its rows
/// as compressClusters does. A layer without receivers has no clusters.
///
/// @param field   its layers go as they are compressed: whoever needs it still passes a copy
/// @throws Error  as compressClusters
CompressedTransfer compressTransfer(TransferField field, const CompressOptions& options = {});

}  // namespace prt
