#pragma once

#include <string>
#include <vector>

#include "apps/prt/stage_log.h"
#include "prt/compress/compress_transfer.h"
#include "prt/compress/compression_error.h"
#include "prt/light/lighting.h"

namespace prt::cli {

/// A layer stored in one of the ways there are, and what that costs.
struct CompressionTrial {
    std::string family{};      ///< of trials that differ in size alone: "clustered PCA, 8 bits"
    std::string options{};     ///< of prt compress: "--method cpca --clusters 64 --components 7"
    double bytes = 0.0;        ///< a vertex, as countBytesPerReceiver has them
    double sharedBytes = 0.0;  ///< of these, the share of the bases
    CompressionError error{};
    double compressSeconds = 0.0;
    double relightSeconds = 0.0;  ///< of all vertices, on one core
};

/// Looks what a layer costs as it is stored; the time of storing it stays open.
///
/// @param original, compressed  the same layer, alone
/// @param light                 under which the error is seen, and which relights
CompressionTrial judgeCompression(const CompressedTransfer& original,
                                  const CompressedTransfer& compressed, const Lighting& light);

/// Tries every method in several sizes.
///
/// @param seed  of the clusters
std::vector<CompressionTrial> tryCompressions(const CompressedTransfer& original,
                                              const Lighting& light, const CompressOptions& common,
                                              StageLog& log);

}  // namespace prt::cli
