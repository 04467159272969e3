#include "prt/compress/compress_clusters.h"

#include <string>
#include <utility>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/compress/cluster_encoding.h"
#include "prt/compress/cluster_training.h"

namespace prt {

std::size_t largestClusterCount(TransferEncoding encoding) {
    switch (encoding) {
        case TransferEncoding::unorm8:
            return std::size_t{1} << 8;
        case TransferEncoding::unorm16:
            return std::size_t{1} << 16;
        case TransferEncoding::float32:
            break;
    }
    return std::size_t{1} << 24;  // floats hold integers up to this one
}

ClusteredTable compressClusters(const CoefficientTable& numbers,
                                std::span<const float> errorWeights, const ClusterOptions& options,
                                TransferEncoding weightEncoding, int threadCount,
                                const ProgressCallback& progress) {
    PRT_ASSERT(numbers.rowCount() > 0 && options.clusterCount > 0, "there is a row and a cluster");
    const std::size_t largest = largestClusterCount(weightEncoding);
    if (options.clusterCount > largest)
        throw Error(ErrorCode::invalidOption,
                    std::string(encodingName(weightEncoding)) + " weights number at most " +
                        std::to_string(largest) + " clusters, not " +
                        std::to_string(options.clusterCount),
                    {}, "use fewer clusters, or weights of more bits");
    const Clusters clusters = trainClusters(numbers, errorWeights, options, threadCount, progress);
    ProgressReporter reporter(progress, "encode", "receivers", 2 * numbers.rowCount());
    const RowEncoding encoding{numbers, errorWeights, threadCount, reporter};
    RowAssignment assignment = assignRows(encoding, clusters);
    ClusterBases bases = foldRanges(clusters, options.basesEncoding, assignment);
    StoredTable table = encodeRows(encoding, assignment.labels, bases, weightEncoding);
    return {std::move(table), std::move(bases)};
}

}  // namespace prt
