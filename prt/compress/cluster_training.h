#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "prt/compress/compress_clusters.h"

namespace prt {

/// Clusters with a mean and components each, as ClusteredPca has them.
struct Clusters {
    std::size_t dimension = 0;
    std::vector<float> means;
    std::vector<float> components;
    std::vector<std::size_t> firstComponent;

    std::size_t count() const { return means.size() / dimension; }
    std::size_t componentCount(std::size_t cluster) const {
        return firstComponent[cluster + 1] - firstComponent[cluster];
    }
};

/// Finds clusters for the rows of a table, from as many of them as the options say.
Clusters trainClusters(const CoefficientTable& numbers, std::span<const float> errorWeights,
                       const ClusterOptions& options, int threadCount,
                       const ProgressCallback& progress);

}  // namespace prt
