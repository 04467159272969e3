// Bibliography
//   [Sloan03]  Clustered principal components for precomputed radiance transfer
#include "prt/relight/cluster_blocks.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "prt/base/assert.h"

namespace prt {
namespace {

/// So many receivers of a cluster take a block longer than one by one.
constexpr std::size_t kMostSingles = 5;

/// Receivers of all parts that are relit in the same way, as they are collected.
template <class Stored>
struct Collected {
    std::vector<std::uint32_t> clusters;
    std::vector<std::uint16_t> stagedAt;
    std::vector<Stored> weights;
    std::vector<std::size_t> clusterEnds;   ///< of each part
    std::vector<std::size_t> receiverEnds;  ///< of each part
    std::vector<std::size_t> weightEnds;    ///< of each part

    void endPart() {
        clusterEnds.push_back(clusters.size());
        receiverEnds.push_back(stagedAt.size());
        weightEnds.push_back(weights.size());
    }
};

/// The rows of a part's receivers as they are stored, and their clusters.
template <class Stored>
struct PartRows {
    std::vector<std::uint32_t> clusters;
    std::size_t rowLength = 0;
    std::vector<Stored> rows;

    PartRows(const CompressedLayer& layer, std::size_t begin)
        : clusters(std::min(kClusterPartSize, layer.table.numbers.rowCount() - begin)),
          rowLength(layer.table.numbers.columnCount()),
          rows(clusters.size() * rowLength) {
        readClusters(layer, begin, clusters);
        for (std::size_t i = 0; i < clusters.size(); ++i)
            layer.table.numbers.readRow(begin + i,
                                        std::span(rows).subspan(i * rowLength, rowLength));
    }

    Stored weight(std::uint16_t receiver, std::size_t component) const {
        return rows[receiver * rowLength + 1 + component];
    }
};

/// Collects some receivers of one cluster as a block of so many lanes, the last repeated in those
/// left over.
template <class Stored>
void collectBlock(const PartRows<Stored>& part, std::span<const std::uint16_t> receivers,
                  std::size_t laneCount, std::size_t componentCount, Collected<Stored>& collected) {
    const auto receiverOf = [&](std::size_t lane) {
        return receivers[std::min(lane, receivers.size() - 1)];
    };
    collected.clusters.push_back(part.clusters[receivers.front()]);
    for (std::size_t lane = 0; lane < laneCount; ++lane)
        collected.stagedAt.push_back(static_cast<std::uint16_t>(receiverOf(lane) * kStagedRowSize));
    for (std::size_t p = 0; p < componentCount; ++p) {
        for (std::size_t lane = 0; lane < laneCount; ++lane)
            collected.weights.push_back(part.weight(receiverOf(lane), p));
    }
}

/// Cuts the receivers of each cluster into full blocks, and the rest into one more or singles.
template <class Stored>
void collectPart(const PartRows<Stored>& part, std::span<const std::uint32_t> componentCounts,
                 Collected<Stored>& blocks, Collected<Stored>& singles) {
    std::vector<std::uint16_t> receivers(part.clusters.size());
    std::iota(receivers.begin(), receivers.end(), std::uint16_t{0});
    std::ranges::stable_sort(receivers, {}, [&](std::uint16_t i) { return part.clusters[i]; });

    std::span<const std::uint16_t> left(receivers);
    while (!left.empty()) {
        const std::uint32_t k = part.clusters[left.front()];
        const std::size_t most = std::min(kRelightBlockSize, left.size());
        std::size_t count = 1;
        while (count < most && part.clusters[left[count]] == k)
            ++count;
        if (count > kMostSingles) {
            collectBlock(part, left.first(count), kRelightBlockSize, componentCounts[k], blocks);
        } else {
            for (std::size_t i = 0; i < count; ++i)
                collectBlock(part, left.subspan(i, 1), 1, componentCounts[k], singles);
        }
        left = left.subspan(count);
    }
    blocks.endPart();
    singles.endPart();
}

/// The `part`th entry, of which `ends` are the ends of each.
std::size_t beginOf(const std::vector<std::size_t>& ends, std::size_t part) {
    return part == 0 ? 0 : ends[part - 1];
}

}  // namespace

std::size_t ClusterBlocks::Group::byteCount() const {
    return std::span(clusters).size_bytes() + std::span(stagedAt).size_bytes() + weightBytes;
}

ClusterBlocks::ClusterBlocks(const CompressedLayer& layer, int bandCount)
    : encoding_(layer.table.encoding),
      vectors_(layer.bases->vectors, bandCount, layer.channelCount) {
    for (const std::size_t first : layer.bases->firstVectors())
        firstVectors_.push_back(static_cast<std::uint32_t>(first));
    switch (encoding_) {
        case TransferEncoding::float32:
            pack<float>(layer);
            break;
        case TransferEncoding::unorm16:
            pack<std::uint16_t>(layer);
            break;
        case TransferEncoding::unorm8:
            pack<std::uint8_t>(layer);
            break;
    }
}

template <class Stored>
void ClusterBlocks::pack(const CompressedLayer& layer) {
    Collected<Stored> blocks, singles;
    for (std::size_t begin = 0; begin < layer.table.numbers.rowCount(); begin += kClusterPartSize)
        collectPart(PartRows<Stored>(layer, begin), layer.bases->componentCounts, blocks, singles);

    const auto keep = [](Collected<Stored>& collected, Group& group) {
        group.clusters = std::move(collected.clusters);
        group.stagedAt = std::move(collected.stagedAt);
        group.weightBytes = std::span(collected.weights).size_bytes();
        group.weights = allocateAlignedBytes(std::max<std::size_t>(group.weightBytes, 1));
        std::ranges::copy(std::as_bytes(std::span(collected.weights)), group.weights.get());
    };
    keep(blocks, blocks_);
    keep(singles, singles_);

    const auto view = [](const Collected<Stored>& collected, const Group& group, std::size_t part) {
        const std::size_t first = beginOf(collected.clusterEnds, part);
        return ClusteredReceivers{
            std::span(group.clusters).subspan(first, collected.clusterEnds[part] - first),
            group.stagedAt.data() + beginOf(collected.receiverEnds, part),
            group.weights.get() + beginOf(collected.weightEnds, part) * sizeof(Stored)};
    };
    for (std::size_t part = 0; part < blocks.clusterEnds.size(); ++part)
        parts_.push_back({view(blocks, blocks_, part), view(singles, singles_, part)});
}

std::size_t ClusterBlocks::byteCount() const {
    return vectors_.byteCount() + std::span(firstVectors_).size_bytes() + blocks_.byteCount() +
           singles_.byteCount();
}

std::vector<Vec3f> ClusterBlocks::multiplyVectors(const Lighting& lighting) const {
    std::vector<Vec3f> products(vectors_.vectorCount() + 1, Vec3f(0.0f));
    vectors_.relight(lighting, 0, ResultStore::cached,
                     std::span(products).first(products.size() - 1));
    // Let components take the weights as they are stored.
    const auto fraction = static_cast<float>(1.0 / largestStored(encoding_));
    for (std::size_t k = 0; k + 1 < firstVectors_.size(); ++k) {
        for (std::size_t i = firstVectors_[k] + 1; i < firstVectors_[k + 1]; ++i)
            products[i] *= fraction;
    }
    return products;
}

void ClusterBlocks::relight(const Lighting& lighting, std::size_t begin, ResultStore store,
                            std::span<Vec3f> radiance) const {
    PRT_ASSERT(begin % kClusterPartSize == 0, "what is asked for begins with a part");
    const std::vector<Vec3f> products = multiplyVectors(lighting);
    const AlignedBytes staged = allocateAlignedBytes(kStagedFloats * sizeof(float));
    const std::size_t partCount = (radiance.size() + kClusterPartSize - 1) / kClusterPartSize;
    relightClusters(encoding_, std::span(parts_).subspan(begin / kClusterPartSize, partCount),
                    {firstVectors_, products.data()}, radiance.size(), store,
                    reinterpret_cast<float*>(staged.get()), radiance.data());
}

}  // namespace prt
