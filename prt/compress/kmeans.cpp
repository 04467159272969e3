#include "prt/compress/kmeans.h"

#include "prt/base/assert.h"
#include "prt/compress/encode_vectors.h"
#include "prt/compress/lloyd.h"
#include "prt/compress/weighted_vectors.h"

namespace prt {

KMeans computeKMeans(const VectorSet& vectors, const KMeansOptions& options) {
    PRT_ASSERT(options.clusterCount > 0, "there is a cluster");
    const WeightedVectors weighted = weighVectors(vectors, options.threadCount);
    KMeansOptions training = options;
    training.clusterCount = std::min(options.clusterCount, vectors.count());
    const std::vector<Subspace> centroids = trainCentroids(weighted, training);
    const std::vector<std::uint32_t> all = allIndices(weighted.count());
    Assignment assignment = assignVectors(weighted, all, centroids, options.threadCount);
    const VectorGroups groups = groupByLabel(all, assignment.labels, centroids.size());

    // Leave out clusters without vectors, and measure the others as they are stored.
    KMeans result{vectors.dimension, {}, std::move(assignment.labels), 0.0};
    for (std::size_t k = 0; k < centroids.size(); ++k) {
        const auto members = groups.members(k);
        if (members.empty()) continue;
        const std::vector<float> centroid = unweighPoint(weighted, centroids[k].mean);
        result.squaredError +=
            encodeVectors(weighted, members, {centroid, {}}, 0, {}, options.threadCount);
        for (const std::uint32_t member : members)
            result.labels[member] = static_cast<std::uint32_t>(result.clusterCount());
        result.centroids.insert(result.centroids.end(), centroid.begin(), centroid.end());
    }
    return result;
}

}  // namespace prt
