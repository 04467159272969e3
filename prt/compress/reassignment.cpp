#include "prt/compress/reassignment.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "prt/parallel/parallel_for.h"

namespace prt {
namespace {

constexpr std::size_t kSampleSize = 64;

/// How well each subspace does for some vectors, spread over a cluster, that are now in the
/// cluster's own: Σ (r_own / r)⁸.
std::vector<double> rateSubspaces(const WeightedVectors& vectors,
                                  std::span<const std::uint32_t> members, const SubspaceRows& rows,
                                  std::size_t own) {
    const std::size_t count = std::min(kSampleSize, members.size());
    std::vector<std::uint32_t> sample(count);
    for (std::size_t i = 0; i < count; ++i)
        sample[i] = members[i * members.size() / count];
    std::vector<float> squaredDistances(rows.subspaceCount * kSampleSize);
    measureSubspaceDistances(vectors, sample, rows, squaredDistances);

    std::vector<double> ratings(rows.subspaceCount, 0.0);
    for (std::size_t k = 0; k < ratings.size(); ++k) {
        for (std::size_t i = 0; i < count; ++i) {
            constexpr double kLeast = std::numeric_limits<float>::min();
            const double ownSquare = squaredDistances[own * kSampleSize + i] + kLeast;
            const double ratio = ownSquare / (squaredDistances[k * kSampleSize + i] + kLeast);
            ratings[k] += std::min(ratio * ratio * ratio * ratio, 1e6);
        }
    }
    return ratings;
}

/// A cluster itself, and then others.
std::vector<std::uint32_t> chooseCandidates(const WeightedVectors& vectors,
                                            std::span<const std::uint32_t> members,
                                            const SubspaceRows& rows, std::size_t own,
                                            Search search) {
    std::vector<std::uint32_t> candidates = allIndices(rows.subspaceCount);
    std::rotate(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(own),
                candidates.begin() + static_cast<std::ptrdiff_t>(own) + 1);
    if (search == Search::all || candidates.size() <= kNearCount || members.empty())
        return candidates;
    const std::vector<double> ratings = rateSubspaces(vectors, members, rows, own);
    std::partial_sort(candidates.begin() + 1, candidates.begin() + kNearCount, candidates.end(),
                      [&](std::uint32_t a, std::uint32_t b) {
                          return ratings[a] != ratings[b] ? ratings[a] > ratings[b] : a < b;
                      });
    candidates.resize(kNearCount);
    return candidates;
}

/// Some members of one cluster.
struct Batch {
    std::size_t cluster = 0;
    std::span<const std::uint32_t> members;
};

std::vector<Batch> cutIntoBatches(const VectorGroups& groups) {
    constexpr std::size_t kBatchSize = 8192;
    std::vector<Batch> batches;
    for (std::size_t k = 0; k < groups.groupCount(); ++k) {
        const auto members = groups.members(k);
        for (std::size_t begin = 0; begin < members.size(); begin += kBatchSize)
            batches.push_back(
                {k, members.subspan(begin, std::min(kBatchSize, members.size() - begin))});
    }
    return batches;
}

}  // namespace

Assignment reassignVectors(const WeightedVectors& vectors, const VectorGroups& groups,
                           std::span<const Subspace> subspaces, Search search, int threadCount) {
    const SubspaceRows allRows(subspaces, allIndices(subspaces.size()));
    std::vector<std::vector<std::uint32_t>> candidates(subspaces.size());
    parallelFor(subspaces.size(), {threadCount, 1}, [&](std::size_t k, std::size_t) {
        candidates[k] = chooseCandidates(vectors, groups.members(k), allRows, k, search);
    });

    Assignment assignment{std::vector<std::uint32_t>(vectors.count()),
                          std::vector<float>(vectors.count())};
    const std::vector<Batch> batches = cutIntoBatches(groups);
    parallelFor(batches.size(), {threadCount, 1}, [&](std::size_t index, std::size_t) {
        const Batch& batch = batches[index];
        const SubspaceRows rows(subspaces, candidates[batch.cluster]);
        std::vector<std::uint32_t> positions(batch.members.size());
        std::vector<float> squaredDistances(batch.members.size());
        findNearestSubspaces(vectors, batch.members, rows, true, {positions, squaredDistances});
        for (std::size_t i = 0; i < positions.size(); ++i) {
            assignment.labels[batch.members[i]] = candidates[batch.cluster][positions[i]];
            assignment.squaredDistances[batch.members[i]] = squaredDistances[i];
        }
    });
    return assignment;
}

}  // namespace prt
