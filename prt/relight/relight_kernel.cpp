#include "prt/relight/relight_kernel.h"

#include <algorithm>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "prt/relight/relight_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "prt/relight/relight_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {
namespace {

/// Copies past the caches, except for the incomplete vectors at both ends.
HWY_INLINE void streamOut(const float* from, std::size_t count, float* to) {
    const FloatTag d;
    const std::size_t vectorSize = hn::Lanes(d);
    const std::size_t head = countUnaligned(to, count);
    std::copy_n(from, head, to);
    std::size_t i = head;
    for (; i + vectorSize <= count; i += vectorSize)
        hn::Stream(hn::LoadU(d, from + i), d, to + i);
    std::copy_n(from + i, count - i, to + i);
}

/// Goes through the blocks once and in sequence: the machine's own prefetching then keeps up, and
/// asking ahead only costs. Results are staged, so that those written past the caches fill whole
/// cache lines wherever the caller's memory begins.
template <int kChannelCount, class Stored>
void relightStored(const Stored* block, std::size_t blockSize, const FoldedLight& light,
                   std::size_t receiverCount, ResultStore store, float* radiance) {
    constexpr std::size_t kStagedReceivers = 16 * kRelightBlockSize;
    HWY_ALIGN float staged[3 * kStagedReceivers];
    for (std::size_t begin = 0; begin < receiverCount; begin += kStagedReceivers) {
        const std::size_t count = std::min(kStagedReceivers, receiverCount - begin);
        for (std::size_t i = 0; i < count; i += kRelightBlockSize, block += blockSize) {
            for (std::size_t lane = 0; lane < kRelightBlockSize; lane += hn::Lanes(FloatTag())) {
                const RgbVector rgb =
                    relightLanes<kChannelCount>(block + lane, light.constant,
                                                light.coefficients.data(), light.coefficientCount);
                hn::StoreInterleaved3(rgb.red, rgb.green, rgb.blue, FloatTag(),
                                      staged + 3 * (i + lane));
            }
        }
        if (store == ResultStore::streaming)
            streamOut(staged, 3 * count, radiance + 3 * begin);
        else
            std::copy_n(staged, 3 * count, radiance + 3 * begin);
    }
    hwy::FlushStream();
}

template <class Stored>
void relightChannels(const TransferBlocks& blocks, const FoldedLight& light,
                     std::size_t receiverCount, ResultStore store, float* radiance) {
    const auto* first = reinterpret_cast<const Stored*>(blocks.data);
    const std::size_t blockSize = blocks.coefficientCount * blocks.channelCount * kRelightBlockSize;
    if (blocks.channelCount == 1)
        relightStored<1>(first, blockSize, light, receiverCount, store, radiance);
    else
        relightStored<3>(first, blockSize, light, receiverCount, store, radiance);
}

void relight(const TransferBlocks& blocks, const FoldedLight& light, std::size_t receiverCount,
             ResultStore store, float* radiance) {
    switch (blocks.encoding) {
        case TransferEncoding::float32:
            return relightChannels<float>(blocks, light, receiverCount, store, radiance);
        case TransferEncoding::unorm16:
            return relightChannels<std::uint16_t>(blocks, light, receiverCount, store, radiance);
        case TransferEncoding::unorm8:
            return relightChannels<std::uint8_t>(blocks, light, receiverCount, store, radiance);
    }
}

}  // namespace
}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace prt {

static_assert(sizeof(Vec3f) == 3 * sizeof(float));

HWY_EXPORT(relight);

void relightBlocks(const TransferBlocks& blocks, const FoldedLight& light,
                   std::size_t receiverCount, ResultStore store, Vec3f* radiance) {
    HWY_DYNAMIC_DISPATCH(relight)
    (blocks, light, receiverCount, store, reinterpret_cast<float*>(radiance));
}

}  // namespace prt
#endif  // HWY_ONCE
