#include "prt/light/lat_long_kernel.h"

#include "prt/base/assert.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "prt/light/lat_long_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, DoubleBlock::kSize>;
using Floats = hn::Rebind<float, Doubles>;
using Vector = hn::Vec<Doubles>;

/// The parts of a row that orders of one parity are summed against, each with red, green and blue
/// apart: even orders against the first two, odd orders against the others.
enum Part : std::size_t { kEvenCosine, kEvenSine, kOddCosine, kOddSine };

struct Channels {
    Vector rgb[3];
};

HWY_INLINE Channels loadTexels(const float* texels) {
    const Doubles d;
    hn::Vec<Floats> red, green, blue;
    hn::LoadInterleaved3(Floats(), texels, red, green, blue);
    return {{hn::PromoteTo(d, red), hn::PromoteTo(d, green), hn::PromoteTo(d, blue)}};
}

HWY_INLINE Channels loadTexelsReversed(const float* texels) {
    const Doubles d;
    const Floats df;
    hn::Vec<Floats> red, green, blue;
    hn::LoadInterleaved3(df, texels, red, green, blue);
    return {{hn::PromoteTo(d, hn::Reverse(df, red)), hn::PromoteTo(d, hn::Reverse(df, green)),
             hn::PromoteTo(d, hn::Reverse(df, blue))}};
}

/// Folds a row of even width, as many texels of its first quarter as fill vectors.
///
/// @return  the texels folded
HWY_INLINE std::size_t foldVectors(const float* row, std::size_t width, std::size_t stride,
                                   double* folded) {
    const Doubles d;
    const std::size_t laneCount = hn::Lanes(d), half = width / 2;
    std::size_t x = 0;
    for (; 2 * (x + laneCount) <= half; x += laneCount) {
        const Channels a = loadTexels(row + 3 * x);
        const Channels b = loadTexelsReversed(row + 3 * (width - laneCount - x));
        const Channels c = loadTexelsReversed(row + 3 * (half - laneCount - x));
        const Channels e = loadTexels(row + 3 * (half + x));
        for (std::size_t i = 0; i < 3; ++i) {
            double* const place = folded + i * stride + x;
            const Vector even = hn::Add(a.rgb[i], b.rgb[i]),
                         evenBeyond = hn::Add(c.rgb[i], e.rgb[i]);
            const Vector odd = hn::Sub(a.rgb[i], b.rgb[i]), oddBeyond = hn::Sub(c.rgb[i], e.rgb[i]);
            hn::Store(hn::Add(even, evenBeyond), d, place + 3 * kEvenCosine * stride);
            hn::Store(hn::Sub(odd, oddBeyond), d, place + 3 * kEvenSine * stride);
            hn::Store(hn::Sub(even, evenBeyond), d, place + 3 * kOddCosine * stride);
            hn::Store(hn::Add(odd, oddBeyond), d, place + 3 * kOddSine * stride);
        }
    }
    return x;
}

/// Folds a row of interleaved channels at φ, −φ and, where there are such texels, ±(π − φ).
HWY_INLINE void foldRow(const float* row, std::size_t width, std::size_t stride, double* folded) {
    const bool isEven = width % 2 == 0;
    const std::size_t half = width / 2;
    for (std::size_t x = isEven ? foldVectors(row, width, stride, folded) : 0;
         x < foldedRowSize(width); ++x) {
        for (std::size_t i = 0; i < 3; ++i) {
            double* const place = folded + i * stride + x;
            const auto at = [row, i](std::size_t texel) { return double{row[3 * texel + i]}; };
            const double a = at(x), b = at(width - 1 - x);
            const double c = isEven ? at(half - 1 - x) : 0.0, e = isEven ? at(half + x) : 0.0;
            place[3 * kEvenCosine * stride] = (a + b) + (c + e);
            place[3 * kEvenSine * stride] = (a - b) - (c - e);
            place[3 * kOddCosine * stride] = (a + b) - (c + e);
            place[3 * kOddSine * stride] = (a - b) + (c - e);
        }
    }
}

HWY_INLINE Vec3d sumLanes(const Vector* channels) {
    const Doubles d;
    return Vec3d(hn::GetLane(hn::SumOfLanes(d, channels[0])),
                 hn::GetLane(hn::SumOfLanes(d, channels[1])),
                 hn::GetLane(hn::SumOfLanes(d, channels[2])));
}

/// Sums a folded row against the functions of every second order from m up to m + 2(kOrders − 1);
/// the more at once, the fewer loads.
template <std::size_t kOrders>
HWY_INLINE void sumOrders(const double* folded, const AzimuthFunctions& functions, std::size_t m,
                          AzimuthSum* sums) {
    const Doubles d;
    const std::size_t stride = functions.blockCount * DoubleBlock::kSize;
    const double* const parts = folded + 3 * (m % 2 == 0 ? kEvenCosine : kOddCosine) * stride;
    const double* const cosines = functions.cosines.data()->lanes + m * stride;
    const double* const sines = functions.sines.data()->lanes + m * stride;
    Vector even[3 * kOrders], odd[3 * kOrders];
    for (std::size_t i = 0; i < 3 * kOrders; ++i)
        even[i] = odd[i] = hn::Zero(d);
    for (std::size_t x = 0; x < stride; x += hn::Lanes(d)) {
        Vector channels[6];
        for (std::size_t i = 0; i < 6; ++i)
            channels[i] = hn::Load(d, parts + i * stride + x);
        for (std::size_t order = 0; order < kOrders; ++order) {
            const Vector cosine = hn::Load(d, cosines + 2 * order * stride + x);
            const Vector sine = hn::Load(d, sines + 2 * order * stride + x);
            for (std::size_t i = 0; i < 3; ++i) {
                even[3 * order + i] = hn::MulAdd(cosine, channels[i], even[3 * order + i]);
                odd[3 * order + i] = hn::MulAdd(sine, channels[3 + i], odd[3 * order + i]);
            }
        }
    }
    for (std::size_t order = 0; order < kOrders; ++order)
        sums[m + 2 * order] = {sumLanes(even + 3 * order), sumLanes(odd + 3 * order)};
}

void integrateFoldedRow(const float* row, std::size_t width, const AzimuthFunctions& functions,
                        double* folded, AzimuthSum* sums) {
    foldRow(row, width, functions.blockCount * DoubleBlock::kSize, folded);
    const auto orderCount = static_cast<std::size_t>(functions.orderCount);
    for (std::size_t parity = 0; parity < 2; ++parity) {
        std::size_t m = parity;
        for (; m + 2 < orderCount; m += 4)
            sumOrders<2>(folded, functions, m, sums);
        if (m < orderCount) sumOrders<1>(folded, functions, m, sums);
    }
}

}  // namespace
}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace prt {

HWY_EXPORT(integrateFoldedRow);

void integrateRow(std::span<const Vec3f> row, const AzimuthFunctions& functions,
                  std::span<DoubleBlock> scratch, std::span<AzimuthSum> sums) {
    const auto orderCount = static_cast<std::size_t>(functions.orderCount);
    PRT_ASSERT(functions.foldedSize == foldedRowSize(row.size()) &&
                   functions.blockCount * DoubleBlock::kSize >= functions.foldedSize &&
                   functions.cosines.size() == orderCount * functions.blockCount &&
                   functions.sines.size() == functions.cosines.size(),
               "the functions are those of the row");
    PRT_ASSERT(scratch.size() == 12 * functions.blockCount && sums.size() == orderCount,
               "there is room for each part, channel and order");
    HWY_DYNAMIC_DISPATCH(integrateFoldedRow)
    (&row.data()->x, row.size(), functions, scratch.data()->lanes, sums.data());
}

}  // namespace prt
#endif  // HWY_ONCE
