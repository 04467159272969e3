// Bibliography
//   [Sloan02]  Precomputed radiance transfer: B is an inner product of light and transfer
//   [Sloan03]  Clustered principal components for precomputed radiance transfer
#include "prt/relight/relighter.h"

#include <variant>

#include "prt/base/assert.h"
#include "prt/relight/cluster_blocks.h"
#include "prt/relight/require_layer.h"
#include "prt/relight/vector_blocks.h"

namespace prt {
namespace {

/// Results larger than this leave a core's own cache before anybody reads them.
constexpr std::size_t kStreamingBytes = std::size_t{2} << 20;

std::variant<VectorBlocks, ClusterBlocks> makeBlocks(const CompressedTransfer& transfer,
                                                     const CompressedLayer& layer) {
    PRT_ASSERT(transfer.bandCount >= 1 && transfer.bandCount <= kMaxBandCount,
               "a band count of the kernels");
    PRT_ASSERT(!isGlossy(layer.transport), "a layer of vectors");
    PRT_ASSERT(layer.channelCount == 1 || layer.channelCount == 3, "grey or coloured transfer");
    PRT_ASSERT(isComplete(transfer, layer), "transfer for each receiver");
    if (layer.bases) return ClusterBlocks(layer, transfer.bandCount);
    return VectorBlocks(layer.table, transfer.bandCount, layer.channelCount);
}

static_assert(kRelightPartSize % kRelightBlockSize == 0 &&
              kRelightPartSize % kClusterPartSize == 0);

}  // namespace

struct Relighter::Blocks {
    int bandCount = 0;
    std::size_t receiverCount = 0;
    std::variant<VectorBlocks, ClusterBlocks> transfer;

    Blocks(const CompressedTransfer& asset, const CompressedLayer& layer)
        : bandCount(asset.bandCount),
          receiverCount(asset.receiverCount),
          transfer(makeBlocks(asset, layer)) {}
};

Relighter::Relighter(const CompressedTransfer& transfer, Transport transport)
    : blocks_(std::make_unique<Blocks>(transfer, requireLayer(transfer, transport))) {}

Relighter::~Relighter() = default;
Relighter::Relighter(Relighter&&) noexcept = default;
Relighter& Relighter::operator=(Relighter&&) noexcept = default;

std::size_t Relighter::receiverCount() const {
    return blocks_->receiverCount;
}

int Relighter::bandCount() const {
    return blocks_->bandCount;
}

std::size_t Relighter::transferBytes() const {
    return std::visit([](const auto& blocks) { return blocks.byteCount(); }, blocks_->transfer);
}

void Relighter::relight(const Lighting& lighting, std::span<Vec3f> radiance) const {
    PRT_ASSERT(radiance.size() == receiverCount(), "one result a receiver");
    relight(lighting, 0, radiance);
}

void Relighter::relight(const Lighting& lighting, std::size_t begin,
                        std::span<Vec3f> radiance) const {
    PRT_ASSERT(lighting.bandCount <= bandCount(), "light has no more bands than transfer");
    PRT_ASSERT(lighting.coefficients.size() ==
                   static_cast<std::size_t>(shCoefficientCount(lighting.bandCount)),
               "n² coefficients of light");
    PRT_ASSERT(begin % kRelightPartSize == 0, "a part begins where parts may");
    PRT_ASSERT(begin <= receiverCount() && radiance.size() <= receiverCount() - begin,
               "a part lies within the receivers");
    if (radiance.empty()) return;
    const bool isLarge = receiverCount() * sizeof(Vec3f) > kStreamingBytes;
    const ResultStore store = isLarge ? ResultStore::streaming : ResultStore::cached;
    std::visit([&](const auto& blocks) { blocks.relight(lighting, begin, store, radiance); },
               blocks_->transfer);
}

}  // namespace prt
