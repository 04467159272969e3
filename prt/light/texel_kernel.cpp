#include "prt/light/texel_kernel.h"

#include <algorithm>
#include <utility>

#include "prt/base/assert.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "prt/light/texel_kernel.cpp"
#include <hwy/foreach_target.h>

#include "prt/basis/sh-inl.h"

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {
namespace {

constexpr std::size_t kSize = TexelBlock::kSize;

/// Numbers of a function's sums: a lane for each texel of a block, of red, green and blue.
constexpr std::size_t kStride = 3 * kSize;

/// @param radiance  of the block's texels, as many numbers as a stride
template <int kBandCount>
HWY_INLINE void addBlock(const TexelBlock& block, const float* radiance, float* sums) {
    const hn::CappedTag<float, kSize> d;
    using Vector = hn::Vec<decltype(d)>;
    for (std::size_t j = 0; j < kSize; j += hn::Lanes(d)) {
        Vector red, green, blue;
        hn::LoadInterleaved3(d, radiance + 3 * j, red, green, blue);
        const Vector solidAngle = hn::Load(d, block.solidAngle + j);
        const auto isShown = hn::Gt(solidAngle, hn::Zero(d));
        red = hn::IfThenElseZero(isShown, hn::Mul(red, solidAngle));
        green = hn::IfThenElseZero(isShown, hn::Mul(green, solidAngle));
        blue = hn::IfThenElseZero(isShown, hn::Mul(blue, solidAngle));
        float* const lanes = sums + j;
        evaluateShLanes<kBandCount>(
            d, hn::Load(d, block.x + j), hn::Load(d, block.y + j), hn::Load(d, block.z + j),
            [d, red, green, blue, lanes](int index, auto value) HWY_ATTR {
                float* const place = lanes + kStride * static_cast<std::size_t>(index);
                hn::Store(hn::MulAdd(value, red, hn::Load(d, place)), d, place);
                hn::Store(hn::MulAdd(value, green, hn::Load(d, place + kSize)), d, place + kSize);
                hn::Store(hn::MulAdd(value, blue, hn::Load(d, place + 2 * kSize)), d,
                          place + 2 * kSize);
            });
    }
}

template <int kBandCount>
void addBlocks(const TexelBlock* blocks, const std::size_t* firstTexels, std::size_t blockCount,
               const float* image, std::size_t texelCount, Vec3d* coefficients) {
    constexpr std::size_t kBlocksInFloats = 64;
    constexpr auto kCount = static_cast<std::size_t>(shCoefficientCount(kBandCount));
    alignas(64) float sums[kStride * kCount];
    for (std::size_t begin = 0; begin < blockCount; begin += kBlocksInFloats) {
        std::fill(std::begin(sums), std::end(sums), 0.0f);
        for (std::size_t b = begin; b < std::min(begin + kBlocksInFloats, blockCount); ++b) {
            const std::size_t first = firstTexels[b];
            const float* radiance = image + 3 * first;
            float padded[kStride] = {};
            if (first + kSize > texelCount)  // the image ends inside the block
                radiance = (std::copy(radiance, image + 3 * texelCount, padded), padded);
            addBlock<kBandCount>(blocks[b], radiance, sums);
        }
        for (std::size_t i = 0; i < kCount; ++i)
            for (std::size_t j = 0; j < kStride; ++j)
                coefficients[i][static_cast<int>(j / kSize)] += double{sums[kStride * i + j]};
    }
}

/// Picks the straight-line code of the band count.
template <int... kLower>
void dispatchBandCount(std::integer_sequence<int, kLower...>, int bandCount,
                       const TexelBlock* blocks, const std::size_t* firstTexels,
                       std::size_t blockCount, const float* image, std::size_t texelCount,
                       Vec3d* coefficients) {
    ((bandCount == kLower + 1
          ? addBlocks<kLower + 1>(blocks, firstTexels, blockCount, image, texelCount, coefficients)
          : void()),
     ...);
}

void addAllBlocks(int bandCount, const TexelBlock* blocks, const std::size_t* firstTexels,
                  std::size_t blockCount, const float* image, std::size_t texelCount,
                  Vec3d* coefficients) {
    dispatchBandCount(std::make_integer_sequence<int, kMaxBandCount>(), bandCount, blocks,
                      firstTexels, blockCount, image, texelCount, coefficients);
}

}  // namespace
}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace prt {

HWY_EXPORT(addAllBlocks);

void projectTexelBlocks(std::span<const TexelBlock> blocks,
                        std::span<const std::size_t> firstTexels, std::span<const Vec3f> radiance,
                        int bandCount, std::span<Vec3d> coefficients) {
    PRT_ASSERT(bandCount >= 1 && bandCount <= kMaxBandCount, "there is code for so many bands");
    PRT_ASSERT(firstTexels.size() == blocks.size(), "each block has its place");
    PRT_ASSERT(firstTexels.empty() || firstTexels.back() < radiance.size(),
               "the blocks are those of the image");
    PRT_ASSERT(coefficients.size() == static_cast<std::size_t>(shCoefficientCount(bandCount)),
               "there is room for each function");
    HWY_DYNAMIC_DISPATCH(addAllBlocks)
    (bandCount, blocks.data(), firstTexels.data(), blocks.size(), &radiance.data()->x,
     radiance.size(), coefficients.data());
}

}  // namespace prt
#endif  // HWY_ONCE
