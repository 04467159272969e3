#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/compress/cluster_training.h"

namespace prt {

/// Rows in clusters, and how far their weights go.
struct RowAssignment {
    std::vector<std::uint32_t> labels;  ///< [row]
    std::vector<std::size_t> counts;    ///< of rows: [cluster]
    std::vector<double> low, high;      ///< of t over the cluster's rows: [component]
};

/// What the steps below have in common.
struct RowEncoding {
    const CoefficientTable& numbers;
    std::span<const float> errorWeights;  ///< as VectorSet has them
    int threadCount;
    ProgressReporter& reporter;  ///< advances by a unit a row
};

/// Finds the cluster that reproduces each row best.
RowAssignment assignRows(const RowEncoding& encoding, const Clusters& clusters);

/// Moves each mean to where the weights begin, and gives each component the length of their range.
/// Clusters without rows, and components of no length, are left out.
///
/// @param assignment  whose labels become those of the clusters that are left
ClusterBases foldRanges(const Clusters& clusters, TransferEncoding encoding,
                        RowAssignment& assignment);

/// Stores the cluster and the weights of each row: those in [0, 1] that are best for the bases as
/// they are stored.
///
/// @param labels  [row], of the bases
StoredTable encodeRows(const RowEncoding& encoding, std::span<const std::uint32_t> labels,
                       const ClusterBases& bases, TransferEncoding weightEncoding);

}  // namespace prt
