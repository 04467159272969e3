// Bibliography
//   [Sloan02]  Precomputed radiance transfer: B is an inner product of light and transfer
//   [Kautz04]  Integer transfer with a scale and a bias for each coefficient
#include "prt/relight/relighter.h"

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <string>
#include <vector>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/relight/relight_kernel.h"

namespace prt {
namespace {

/// Results larger than this leave a core's own cache before anybody reads them.
constexpr std::size_t kStreamingBytes = std::size_t{2} << 20;

const CompressedLayer& requireLayer(const CompressedTransfer& transfer, Transport transport) {
    if (const CompressedLayer* layer = transfer.findLayer(transport)) return *layer;
    std::string available;
    for (const CompressedLayer& layer : transfer.layers)
        available +=
            (available.empty() ? "it has " : ", ") + std::string(transportName(layer.transport));
    throw Error(ErrorCode::invalidOption,
                "the asset holds no " + std::string(transportName(transport)) + " transfer", {},
                available);
}

/// The factor and the summand that make a transfer coefficient of a stored number.
struct StoredRange {
    double scale = 1.0;
    double bias = 0.0;
};

/// One a channel and coefficient, in the layer's order.
std::vector<StoredRange> storedRanges(const CompressedLayer& layer, std::size_t rowCount) {
    std::vector<StoredRange> ranges(rowCount);
    if (layer.table.encoding == TransferEncoding::float32) return ranges;
    PRT_ASSERT(layer.table.scale.size() == rowCount && layer.table.bias.size() == rowCount,
               "a scale and a bias for each channel and coefficient");
    const double largest = largestStored(layer.table.encoding);
    for (std::size_t row = 0; row < rowCount; ++row)
        ranges[row] = {static_cast<double>(layer.table.scale[row]) / largest,
                       static_cast<double>(layer.table.bias[row])};
    return ranges;
}

/// Reorders [receiver][channel][coefficient] to blocks [coefficient][channel][16 receivers].
template <class Stored>
void packBlocks(const CompressedLayer& layer, const TransferBlocks& shape,
                std::size_t receiverCount, Stored* blocks) {
    const std::size_t rowCount = shape.channelCount * shape.coefficientCount;
    std::vector<Stored> receiver(rowCount);
    for (std::size_t r = 0; r < receiverCount; ++r) {
        layer.table.numbers.readRow(r, std::span(receiver));
        Stored* const lane =
            blocks + r / kRelightBlockSize * rowCount * kRelightBlockSize + r % kRelightBlockSize;
        for (std::size_t channel = 0; channel < shape.channelCount; ++channel) {
            for (std::size_t i = 0; i < shape.coefficientCount; ++i)
                lane[(i * shape.channelCount + channel) * kRelightBlockSize] =
                    receiver[channel * shape.coefficientCount + i];
        }
    }
}

}  // namespace

struct Relighter::Blocks {
    int bandCount = 0;
    std::size_t receiverCount = 0;
    std::size_t blockBytes = 0;
    std::vector<StoredRange> ranges;  ///< [channel][coefficient]
    hwy::AlignedFreeUniquePtr<std::byte[]> bytes;
    TransferBlocks view;

    Blocks(const CompressedTransfer& transfer, const CompressedLayer& layer)
        : bandCount(transfer.bandCount), receiverCount(transfer.receiverCount) {
        view.encoding = layer.table.encoding;
        view.channelCount = static_cast<std::size_t>(layer.channelCount);
        view.coefficientCount = static_cast<std::size_t>(shCoefficientCount(bandCount));
        const std::size_t rowCount = coefficientsPerReceiver(bandCount, layer.channelCount);
        const std::size_t rowBytes = bytesPerCoefficient(layer.table.encoding);
        PRT_ASSERT(bandCount >= 1 && bandCount <= kMaxBandCount, "a band count of the kernels");
        PRT_ASSERT(layer.channelCount == 1 || layer.channelCount == 3, "grey or coloured transfer");
        PRT_ASSERT(isComplete(transfer, layer), "a vector a receiver");
        ranges = storedRanges(layer, rowCount);

        // Fill the last block up with zeros, then copy what there is.
        blockBytes = rowCount * rowBytes * kRelightBlockSize;
        const std::size_t allocatedBytes = std::max(transferBytes(), blockBytes);
        bytes = hwy::AllocateAligned<std::byte>(allocatedBytes);
        if (!bytes) throw Error(ErrorCode::outOfMemory, "the transfer does not fit in memory");
        std::fill_n(bytes.get() + allocatedBytes - blockBytes, blockBytes, std::byte{0});
        view.data = bytes.get();
        pack(layer);
    }

    std::size_t transferBytes() const {
        return (receiverCount + kRelightBlockSize - 1) / kRelightBlockSize * blockBytes;
    }

    void pack(const CompressedLayer& layer) {
        const auto packAs = [&](auto* blocks) { packBlocks(layer, view, receiverCount, blocks); };
        switch (layer.table.encoding) {
            case TransferEncoding::float32:
                return packAs(reinterpret_cast<float*>(bytes.get()));
            case TransferEncoding::unorm16:
                return packAs(reinterpret_cast<std::uint16_t*>(bytes.get()));
            case TransferEncoding::unorm8:
                return packAs(reinterpret_cast<std::uint8_t*>(bytes.get()));
        }
    }

    FoldedLight fold(const Lighting& lighting) const {
        FoldedLight folded;
        folded.coefficientCount = static_cast<std::size_t>(shCoefficientCount(lighting.bandCount));
        Vec3d constant(0.0);
        for (std::size_t i = 0; i < folded.coefficientCount; ++i) {
            for (int color = 0; color < 3; ++color) {
                const std::size_t channel =
                    view.channelCount == 3 ? static_cast<std::size_t>(color) : 0;
                const StoredRange& range = ranges[channel * view.coefficientCount + i];
                const double light = lighting.coefficients[i][color];
                folded.coefficients[i][color] = static_cast<float>(range.scale * light);
                constant[color] += range.bias * light;
            }
        }
        folded.constant = Vec3f(constant);
        return folded;
    }
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
    return blocks_->transferBytes();
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
    PRT_ASSERT(begin % kRelightBlockSize == 0, "a part begins with a block");
    PRT_ASSERT(begin <= receiverCount() && radiance.size() <= receiverCount() - begin,
               "a part lies within the receivers");
    if (radiance.empty()) return;
    TransferBlocks blocks = blocks_->view;
    blocks.data += begin / kRelightBlockSize * blocks_->blockBytes;
    const bool isLarge = receiverCount() * sizeof(Vec3f) > kStreamingBytes;
    relightBlocks(blocks, blocks_->fold(lighting), radiance.size(),
                  isLarge ? ResultStore::streaming : ResultStore::cached, radiance.data());
}

}  // namespace prt
