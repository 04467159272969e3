// Bibliography
//   [Dachsbacher17]  Precomputed radiance transfer
//   [Pinchon07]      Rotation matrices for real spherical harmonics
#include <algorithm>

#include "prt/base/assert.h"
#include "prt/basis/sh_rotation.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "prt/basis/sh_rotation_batch.cpp"
#include <hwy/foreach_target.h>

#include "prt/basis/sh_rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {
namespace {

void rotateBatch(int bandCount, const float* rotations, const float* source, float* rotated) {
    const hn::CappedTag<float, kShBatchSize> d;
    using V = hn::Vec<decltype(d)>;
    for (std::size_t j = 0; j < kShBatchSize; j += hn::Lanes(d)) {
        V matrix[9];
        for (std::size_t entry = 0; entry < 9; ++entry)
            matrix[entry] = hn::LoadU(d, rotations + kShBatchSize * entry + j);
        Turns<V> turns = findTurns(d, matrix);
        computeMultiples(bandCount, turns);
        hn::StoreU(hn::LoadU(d, source + j), d, rotated + j);
        rotateBands<kShBatchSize, 1>(d, turns, bandCount, source + j, rotated + j);
    }
}

}  // namespace
}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace prt {

HWY_EXPORT(rotateBatch);

void rotateShBatch(std::span<const float, 9 * kShBatchSize> rotations, int bandCount,
                   std::span<const float> source, std::span<float> rotated) {
    PRT_ASSERT(bandCount >= 1 && bandCount <= kMaxBandCount,
               "straight-line code exists for this band count");
    const auto count = static_cast<std::size_t>(shCoefficientCount(bandCount));
    PRT_ASSERT(source.size() == count || source.size() == count * kShBatchSize,
               "there is one coefficient a function, for all or for each");
    PRT_ASSERT(rotated.size() == count * kShBatchSize, "there is room for each function");
    if (source.size() == count) {
        for (std::size_t i = 0; i < count; ++i)
            std::fill_n(&rotated[kShBatchSize * i], kShBatchSize, source[i]);
        source = rotated;
    }
    HWY_DYNAMIC_DISPATCH(rotateBatch)(bandCount, rotations.data(), source.data(), rotated.data());
}

}  // namespace prt
#endif  // HWY_ONCE
