#pragma once

#include "prt/compress/compress_clusters.h"
#include "prt/transfer/compressed_transfer.h"
#include "prt/transfer/transfer_field.h"

namespace prt {

/// What a compressed layer may cost, or how good it has to be; one of them is given.
struct CompressionBudget {
    double bytesPerReceiver = 0.0;  ///< countBytesPerReceiver of the layer, at most
    double maxError = 0.0;  ///< with a light the error as seen, without the relative root mean
                            ///< square, at most: CompressionError of what is stored
};

/// All bytes of a layer, over its receivers: attributes of four numbers each, as an asset has them,
/// and the bases' share.
double countBytesPerReceiver(const CompressedLayer& layer);

/// Finds how many clusters and components, with 8 or 16 bits a weight, give the least error for a
/// number of bytes, or the fewest bytes for an error, and stores a layer so. Where clusters do not
/// pay, because there are few receivers or hardly any error is allowed, it is stored by columns.
///
/// Tries what may be best on up to 2¹⁵ receivers, or 10⁷ numbers, that are spread over all. What is
/// promised is promised of the result: under maxError it is measured, and where a trial was too
/// hopeful, the next better one is taken; and a cluster has no more components than it needs.
///
/// The same seed gives the same bits for any number of threads (C10).
///
/// @param layer     at least one receiver; finite
/// @param options   of clusters; its counts and maxError are not used
/// @param progress  stage "choose" and those of compressClusters
/// @throws Error    invalidOption where nothing takes as few bytes, cancelled
CompressedLayer compressToBudget(const TransferLayer& layer, const ClusterOptions& options,
                                 const CompressionBudget& budget, int threadCount = 0,
                                 const ProgressCallback& progress = {});

}  // namespace prt
