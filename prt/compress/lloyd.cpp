// Bibliography
//   [Arthur07]  k-means++: the advantages of careful seeding
//   [Lloyd82]   Least squares quantization in PCM
#include "prt/compress/lloyd.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "prt/base/random.h"
#include "prt/compress/row_kernel.h"
#include "prt/parallel/parallel_for.h"

namespace prt {
namespace {

std::size_t drawBelow(RandomStream& random, std::size_t count) {
    return static_cast<std::size_t>(random.nextUnitDouble() * static_cast<double>(count));
}

std::vector<double> copyVector(const WeightedVectors& vectors, std::uint32_t index) {
    const auto row = vectors.numbers.subspan(index * vectors.dimension, vectors.dimension);
    return weighPoint(vectors, row);
}

/// Draws each seed with probability proportional to the squared distance from those before
/// [Arthur07], from a part of the vectors.
std::vector<Subspace> seedCentroids(const WeightedVectors& vectors, const KMeansOptions& options) {
    constexpr std::size_t kVectorsPerSeed = 16, kLeastCount = 4096, kMostCount = 65536;
    RandomStream random(options.seed, 1);
    const std::size_t drawnCount =
        std::clamp(kVectorsPerSeed * options.clusterCount, kLeastCount, kMostCount);
    const auto indices = drawIndices(vectors.count(), std::max(drawnCount, options.clusterCount),
                                     RandomStream(options.seed, 2));
    const std::size_t size = paddedSize(vectors.dimension);
    const std::vector<double> zero(vectors.dimension, 0.0);
    std::vector<double> rows(indices.size() * size);
    gatherRows(vectors, indices, zero, rows);
    const auto row = [&](std::size_t i, std::size_t count) {
        return std::span<const double>(rows).subspan(i * size, count * size);
    };
    std::vector<double> distances(indices.size(), std::numeric_limits<double>::infinity());
    std::vector<Subspace> seeds;
    std::size_t next = drawBelow(random, indices.size());
    while (true) {
        const auto seed = row(next, 1).first(vectors.dimension);
        seeds.push_back({{seed.begin(), seed.end()}});
        if (seeds.size() == options.clusterCount) break;
        constexpr std::size_t kChunkSize = 4096;
        parallelFor(indices.size(), {options.threadCount, kChunkSize},
                    [&](std::size_t begin, std::size_t end) {
                        lowerDistances(row(begin, end - begin), row(next, 1),
                                       std::span(distances).subspan(begin, end - begin));
                    });
        const double sum = std::accumulate(distances.begin(), distances.end(), 0.0);
        if (sum == 0.0) break;
        double left = random.nextUnitDouble() * sum;
        for (std::size_t i = 0; i < indices.size() && left >= 0.0; ++i) {
            if (distances[i] == 0.0) continue;
            next = i;
            left -= distances[i];
        }
    }
    // Where the part has too few different vectors, the rest are clusters without any, to start
    // anew.
    seeds.resize(options.clusterCount, Subspace{seeds.front()});
    return seeds;
}

/// Sums over the vectors of each cluster.
struct ClusterSums {
    std::vector<double> offsets;      ///< Σ (y − c), [cluster][paddedSize]
    std::vector<std::size_t> counts;  ///< [cluster]
    double squaredError = 0.0;        ///< Σ ‖y − c‖²
};

/// Finds the nearest centroid of each vector, and sums while a batch is in the cache. In parts, of
/// which there are few enough that each can have sums for itself, added in sequence.
ClusterSums assignAndSum(const WeightedVectors& vectors, std::span<const std::uint32_t> indices,
                         std::span<const Subspace> centroids, int threadCount,
                         Assignment& assignment) {
    constexpr std::size_t kLeastPart = 8192, kSumNumbers = std::size_t{1} << 24, kMostParts = 64;
    constexpr std::size_t kBatchSize = 1024;
    const std::size_t size = paddedSize(vectors.dimension);
    std::vector<double> points(centroids.size() * size, 0.0);
    for (std::size_t k = 0; k < centroids.size(); ++k)
        std::copy(centroids[k].mean.begin(), centroids[k].mean.end(), &points[k * size]);
    const SubspaceRows rows(centroids, allIndices(centroids.size()));
    const std::size_t partCount =
        std::clamp<std::size_t>(kSumNumbers / points.size(), 1, kMostParts);
    const std::size_t partSize = std::max(kLeastPart, (indices.size() + partCount - 1) / partCount);
    std::vector<ClusterSums> parts((indices.size() + partSize - 1) / partSize);
    parallelFor(indices.size(), {threadCount, partSize}, [&](std::size_t begin, std::size_t end) {
        ClusterSums& part = parts[begin / partSize];
        part.offsets.assign(points.size(), 0.0);
        part.counts.assign(centroids.size(), 0);
        for (std::size_t i = begin; i < end; i += kBatchSize) {
            const std::size_t count = std::min(kBatchSize, end - i);
            const auto batch = indices.subspan(i, count);
            const auto labels = std::span(assignment.labels).subspan(i, count);
            const auto distances = std::span(assignment.squaredDistances).subspan(i, count);
            findNearestSubspaces(vectors, batch, rows, false, {labels, distances});
            part.squaredError += sumByLabel(vectors, batch, labels, points, part.offsets);
            for (const std::uint32_t label : labels)
                ++part.counts[label];
        }
    });
    ClusterSums total = std::move(parts.front());
    for (std::size_t part = 1; part < parts.size(); ++part) {
        total.squaredError += parts[part].squaredError;
        for (std::size_t k = 0; k < centroids.size(); ++k)
            total.counts[k] += parts[part].counts[k];
        for (std::size_t i = 0; i < points.size(); ++i)
            total.offsets[i] += parts[part].offsets[i];
    }
    return total;
}

/// Moves each centroid to the mean of its vectors; one that has none starts anew at a vector that
/// is far from its own.
std::vector<Subspace> moveCentroids(const WeightedVectors& vectors,
                                    std::span<const std::uint32_t> indices,
                                    const Assignment& assignment, const ClusterSums& sums,
                                    std::vector<Subspace> centroids) {
    const std::size_t size = paddedSize(vectors.dimension);
    std::vector<std::size_t> empty;
    for (std::size_t k = 0; k < centroids.size(); ++k) {
        if (sums.counts[k] == 0) {
            empty.push_back(k);
            continue;
        }
        for (std::size_t j = 0; j < vectors.dimension; ++j)
            centroids[k].mean[j] +=
                sums.offsets[k * size + j] / static_cast<double>(sums.counts[k]);
    }
    const auto farthest = findFarthest(assignment.squaredDistances, empty.size());
    for (std::size_t i = 0; i < farthest.size(); ++i)
        centroids[empty[i]] = {copyVector(vectors, indices[farthest[i]])};
    return centroids;
}

}  // namespace

std::vector<std::uint32_t> drawIndices(std::size_t total, std::size_t count, RandomStream random) {
    if (count >= total) return allIndices(total);
    std::vector<std::uint32_t> indices(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t begin = i * total / count, end = (i + 1) * total / count;
        indices[i] = static_cast<std::uint32_t>(begin + drawBelow(random, end - begin));
    }
    return indices;
}

Assignment assignVectors(const WeightedVectors& vectors, std::span<const std::uint32_t> indices,
                         std::span<const Subspace> subspaces, int threadCount) {
    constexpr std::size_t kChunkSize = 4096;
    const SubspaceRows rows(subspaces, allIndices(subspaces.size()));
    Assignment assignment{std::vector<std::uint32_t>(indices.size()),
                          std::vector<float>(indices.size())};
    parallelFor(indices.size(), {threadCount, kChunkSize}, [&](std::size_t begin, std::size_t end) {
        const std::size_t count = end - begin;
        findNearestSubspaces(vectors, indices.subspan(begin, count), rows, false,
                             {std::span(assignment.labels).subspan(begin, count),
                              std::span(assignment.squaredDistances).subspan(begin, count)});
    });
    return assignment;
}

std::vector<std::size_t> findFarthest(std::span<const float> squaredDistances, std::size_t count) {
    if (count == 0) return {};
    std::vector<std::size_t> positions(squaredDistances.size());
    std::iota(positions.begin(), positions.end(), std::size_t{0});
    count = std::min(count, positions.size());
    const auto end = positions.begin() + static_cast<std::ptrdiff_t>(count);
    std::partial_sort(positions.begin(), end, positions.end(), [&](std::size_t a, std::size_t b) {
        return squaredDistances[a] != squaredDistances[b]
                   ? squaredDistances[a] > squaredDistances[b]
                   : a < b;
    });
    positions.erase(std::find_if(positions.begin(), end,
                                 [&](std::size_t i) { return squaredDistances[i] == 0.0f; }),
                    positions.end());
    positions.resize(std::min(count, positions.size()));
    return positions;
}

std::vector<Subspace> trainCentroids(const WeightedVectors& vectors, const KMeansOptions& options) {
    const std::size_t trainingCount =
        options.trainingCount == 0 ? vectors.count() : options.trainingCount;
    const auto indices = drawIndices(vectors.count(), std::max(trainingCount, options.clusterCount),
                                     RandomStream(options.seed, 3));
    std::vector<Subspace> centroids = seedCentroids(vectors, options);
    std::vector<Subspace> best = centroids;
    Assignment assignment{std::vector<std::uint32_t>(indices.size()),
                          std::vector<float>(indices.size())};
    double leastError = std::numeric_limits<double>::infinity();
    ProgressReporter reporter(options.progress, "quantise", "iterations",
                              options.iterationCount + 1);
    for (std::size_t iteration = 0; iteration <= options.iterationCount; ++iteration) {
        const ClusterSums sums =
            assignAndSum(vectors, indices, centroids, options.threadCount, assignment);
        if (!(sums.squaredError < leastError)) {
            reporter.advance(options.iterationCount + 1 - iteration);
            break;
        }
        leastError = sums.squaredError;
        best = centroids;
        centroids = moveCentroids(vectors, indices, assignment, sums, std::move(centroids));
        reporter.advance(1);
    }
    return best;
}

}  // namespace prt
