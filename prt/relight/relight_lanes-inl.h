// Sums of stored numbers times light for as many receivers as a vector has lanes, which the kernels
// for vectors and for clusters share. Included once a target from a file that
// hwy/foreach_target.h compiles again and again.

#if defined(PRT_RELIGHT_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PRT_RELIGHT_LANES_INL_H_
#undef PRT_RELIGHT_LANES_INL_H_
#else
#define PRT_RELIGHT_LANES_INL_H_
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "prt/relight/relight_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, kRelightBlockSize>;
using Vector = hn::Vec<FloatTag>;

/// Radiance of as many receivers as a vector has lanes.
struct RgbVector {
    Vector red, green, blue;
};

/// Asks for memory in the core's larger cache, so that it is there when what is being read stays.
HWY_INLINE void askFor(const std::byte* memory, std::size_t byteCount) {
    constexpr std::size_t kLineBytes = 64;
    for (std::size_t at = 0; at < byteCount; at += kLineBytes)
        __builtin_prefetch(memory + at, 0, 2);
}

HWY_INLINE Vector loadLanes(const float* stored) {
    return hn::Load(FloatTag(), stored);
}

template <class Integer>
HWY_INLINE Vector loadLanes(const Integer* stored) {
    const hn::Rebind<Integer, FloatTag> storedTag;
    const hn::Rebind<std::int32_t, FloatTag> wideTag;
    return hn::ConvertTo(FloatTag(), hn::PromoteTo(wideTag, hn::Load(storedTag, stored)));
}

/// Adds one coefficient's T_i L_i.
template <int kChannelCount, class Stored>
HWY_INLINE void addCoefficient(const Stored* row, const Vec3f& light, RgbVector& sum) {
    const FloatTag d;
    const Vector red = loadLanes(row);
    Vector green = red;
    Vector blue = red;
    if constexpr (kChannelCount == 3) {
        green = loadLanes(row + kRelightBlockSize);
        blue = loadLanes(row + 2 * kRelightBlockSize);
    }
    sum.red = hn::MulAdd(red, hn::Set(d, light.x), sum.red);
    sum.green = hn::MulAdd(green, hn::Set(d, light.y), sum.green);
    sum.blue = hn::MulAdd(blue, hn::Set(d, light.z), sum.blue);
}

/// Relights as many receivers of a block as a vector has lanes: constant + Σ_i q_i L_i.
///
/// Even and odd coefficients are summed apart: two short chains of
/// dependent additions, not one long.
///
/// @param row  [coefficient][channel][16 lanes], from the first of the lanes on
template <int kChannelCount, class Stored>
HWY_INLINE RgbVector relightLanes(const Stored* row, const Vec3f& constant,
                                  const Vec3f* coefficient, std::size_t coefficientCount) {
    constexpr std::size_t kRowSize = kChannelCount * kRelightBlockSize;
    const FloatTag d;
    const Vector zero = hn::Zero(d);
    RgbVector even = {hn::Set(d, constant.x), hn::Set(d, constant.y), hn::Set(d, constant.z)};
    RgbVector odd = {zero, zero, zero};

    const Vec3f* const end = coefficient + coefficientCount;
    for (; end - coefficient >= 2; coefficient += 2, row += 2 * kRowSize) {
        addCoefficient<kChannelCount>(row, coefficient[0], even);
        addCoefficient<kChannelCount>(row + kRowSize, coefficient[1], odd);
    }
    if (coefficient != end) addCoefficient<kChannelCount>(row, *coefficient, even);
    return {hn::Add(even.red, odd.red), hn::Add(even.green, odd.green),
            hn::Add(even.blue, odd.blue)};
}

/// How many floats lie before the first address, of at most `count`, where vectors are aligned.
HWY_INLINE std::size_t countUnaligned(const float* to, std::size_t count) {
    const std::size_t vectorSize = hn::Lanes(FloatTag());
    const std::size_t phase = reinterpret_cast<std::uintptr_t>(to) / sizeof(float) % vectorSize;
    return std::min(count, (vectorSize - phase) % vectorSize);
}

}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // PRT_RELIGHT_LANES_INL_H_
