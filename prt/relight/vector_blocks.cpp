#include "prt/relight/vector_blocks.h"

#include <algorithm>
#include <cstdint>

#include "prt/base/assert.h"

namespace prt {
namespace {

/// Reorders [vector][channel][coefficient] to blocks [coefficient][channel][16 vectors].
template <class Stored>
void packBlocks(const CoefficientTable& numbers, const TransferBlocks& shape, Stored* blocks) {
    const std::size_t rowCount = shape.channelCount * shape.coefficientCount;
    std::vector<Stored> vector(rowCount);
    for (std::size_t r = 0; r < numbers.rowCount(); ++r) {
        numbers.readRow(r, std::span(vector));
        Stored* const lane =
            blocks + r / kRelightBlockSize * rowCount * kRelightBlockSize + r % kRelightBlockSize;
        for (std::size_t channel = 0; channel < shape.channelCount; ++channel) {
            for (std::size_t i = 0; i < shape.coefficientCount; ++i)
                lane[(i * shape.channelCount + channel) * kRelightBlockSize] =
                    vector[channel * shape.coefficientCount + i];
        }
    }
}

}  // namespace

VectorBlocks::VectorBlocks(const StoredTable& vectors, int bandCount, int channelCount)
    : vectorCount_(vectors.numbers.rowCount()), ranges_(storedRanges(vectors)) {
    view_.encoding = vectors.encoding;
    view_.channelCount = static_cast<std::size_t>(channelCount);
    view_.coefficientCount = static_cast<std::size_t>(shCoefficientCount(bandCount));
    const std::size_t rowCount = view_.channelCount * view_.coefficientCount;
    PRT_ASSERT(vectors.numbers.columnCount() == rowCount,
               "a number for each channel and coefficient");

    // Fill the last block up with zeros, then copy what there is.
    blockBytes_ = rowCount * bytesPerCoefficient(vectors.encoding) * kRelightBlockSize;
    const std::size_t allocatedBytes = std::max(byteCount(), blockBytes_);
    bytes_ = allocateAlignedBytes(allocatedBytes);
    std::fill_n(bytes_.get() + allocatedBytes - blockBytes_, blockBytes_, std::byte{0});
    view_.data = bytes_.get();
    pack(vectors);
}

void VectorBlocks::pack(const StoredTable& vectors) {
    const auto packAs = [&](auto* blocks) { packBlocks(vectors.numbers, view_, blocks); };
    switch (vectors.encoding) {
        case TransferEncoding::float32:
            return packAs(reinterpret_cast<float*>(bytes_.get()));
        case TransferEncoding::unorm16:
            return packAs(reinterpret_cast<std::uint16_t*>(bytes_.get()));
        case TransferEncoding::unorm8:
            return packAs(reinterpret_cast<std::uint8_t*>(bytes_.get()));
    }
}

std::size_t VectorBlocks::byteCount() const {
    return (vectorCount_ + kRelightBlockSize - 1) / kRelightBlockSize * blockBytes_;
}

FoldedLight VectorBlocks::fold(const Lighting& lighting) const {
    FoldedLight folded;
    folded.coefficientCount = static_cast<std::size_t>(shCoefficientCount(lighting.bandCount));
    Vec3d constant(0.0);
    for (std::size_t i = 0; i < folded.coefficientCount; ++i) {
        for (int color = 0; color < 3; ++color) {
            const std::size_t channel =
                view_.channelCount == 3 ? static_cast<std::size_t>(color) : 0;
            const StoredRange& range = ranges_[channel * view_.coefficientCount + i];
            const double light = lighting.coefficients[i][color];
            folded.coefficients[i][color] = static_cast<float>(range.scale * light);
            constant[color] += range.bias * light;
        }
    }
    folded.constant = Vec3f(constant);
    return folded;
}

void VectorBlocks::relight(const Lighting& lighting, std::size_t begin, ResultStore store,
                           std::span<Vec3f> products) const {
    PRT_ASSERT(begin % kRelightBlockSize == 0, "what is asked for begins with a block");
    TransferBlocks blocks = view_;
    blocks.data += begin / kRelightBlockSize * blockBytes_;
    relightBlocks(blocks, fold(lighting), products.size(), store, products.data());
}

}  // namespace prt
