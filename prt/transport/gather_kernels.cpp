#include "prt/transport/gather_kernels.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/math/sampling.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "prt/transport/gather_kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "prt/basis/sh-inl.h"

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, kLaneMultiple>;
using BitLanes = hn::CappedTag<std::uint32_t, kLaneMultiple>;
using Vector = hn::Vec<Lanes>;
using BitVector = hn::Vec<BitLanes>;

HWY_INLINE BitVector reverseBitLanes(BitVector bits) {
    const BitLanes d;
    const auto swap = [&](BitVector v, std::uint32_t mask, auto shift) HWY_ATTR {
        constexpr int kShift = decltype(shift)::value;
        const BitVector low = hn::Set(d, mask);
        return hn::Or(hn::ShiftLeft<kShift>(hn::And(v, low)),
                      hn::And(hn::ShiftRight<kShift>(v), low));
    };
    bits = hn::Or(hn::ShiftLeft<16>(bits), hn::ShiftRight<16>(bits));
    bits = swap(bits, 0x00ff00ffu, std::integral_constant<int, 8>());
    bits = swap(bits, 0x0f0f0f0fu, std::integral_constant<int, 4>());
    bits = swap(bits, 0x33333333u, std::integral_constant<int, 2>());
    return swap(bits, 0x55555555u, std::integral_constant<int, 1>());
}

/// owenScrambleReversed, a point a lane.
HWY_INLINE BitVector scrambleLanes(BitVector bits, std::uint32_t seed) {
    const BitLanes d;
    bits = hn::Xor(bits, hn::Mul(bits, hn::Set(d, 0x3d20adeau)));
    bits = hn::Add(bits, hn::Set(d, seed));
    bits = hn::Mul(bits, hn::Set(d, (seed >> 16) | 1u));
    bits = hn::Xor(bits, hn::Mul(bits, hn::Set(d, 0x05526c56u)));
    return hn::Xor(bits, hn::Mul(bits, hn::Set(d, 0x53a22864u)));
}

/// unitFloatFromBits, a number a lane.
HWY_INLINE Vector unitFromBits(BitVector bits) {
    const Lanes d;
    const auto cells =
        hn::ConvertTo(d, hn::BitCast(hn::RebindToSigned<BitLanes>(), hn::ShiftRight<9>(bits)));
    return hn::MulAdd(cells, hn::Set(d, 0x1p-23f), hn::Set(d, 0x1p-24f));
}

struct Direction {
    Vector x, y, z;
};

/// Sine and cosine of φ = π (2v − 1), from those of a quarter of φ, within ±π/4, where short series
/// are exact to rounding, doubled twice.
HWY_INLINE void sinCosLanes(Vector v, Vector& sine, Vector& cosine) {
    const Lanes d;
    constexpr float kPi = std::numbers::pi_v<float>;
    const Vector angle = hn::MulAdd(v, hn::Set(d, 0.5f * kPi), hn::Set(d, -0.25f * kPi));
    const Vector square = hn::Mul(angle, angle);

    sine = hn::Set(d, 1.0f / 362880.0f);
    sine = hn::MulAdd(sine, square, hn::Set(d, -1.0f / 5040.0f));
    sine = hn::MulAdd(sine, square, hn::Set(d, 1.0f / 120.0f));
    sine = hn::MulAdd(sine, square, hn::Set(d, -1.0f / 6.0f));
    sine = hn::MulAdd(hn::Mul(sine, square), angle, angle);
    cosine = hn::Set(d, 1.0f / 40320.0f);
    cosine = hn::MulAdd(cosine, square, hn::Set(d, -1.0f / 720.0f));
    cosine = hn::MulAdd(cosine, square, hn::Set(d, 1.0f / 24.0f));
    cosine = hn::MulAdd(cosine, square, hn::Set(d, -0.5f));
    cosine = hn::MulAdd(cosine, square, hn::Set(d, 1.0f));
    for (int doubling = 0; doubling < 2; ++doubling) {
        const Vector product = hn::Mul(sine, cosine);
        cosine = hn::NegMulAdd(hn::Add(sine, sine), sine, hn::Set(d, 1.0f));
        sine = hn::Add(product, product);
    }
}

/// sampleCosineHemisphere, a direction a lane.
struct CosineHemisphere {
    static HWY_INLINE Direction map(Vector u, Vector v) {
        const Lanes d;
        Vector sine, cosine;
        sinCosLanes(v, sine, cosine);
        const Vector radius = hn::Sqrt(u);
        return {hn::Mul(radius, cosine), hn::Mul(radius, sine),
                hn::Sqrt(hn::Sub(hn::Set(d, 1.0f), u))};
    }
};

/// sampleUniformHemisphere, a direction a lane.
struct UniformHemisphere {
    static HWY_INLINE Direction map(Vector u, Vector v) {
        const Lanes d;
        Vector sine, cosine;
        sinCosLanes(v, sine, cosine);
        const Vector radius = hn::Sqrt(hn::Mul(u, hn::Sub(hn::Set(d, 2.0f), u)));
        return {hn::Mul(radius, cosine), hn::Mul(radius, sine), hn::Sub(hn::Set(d, 1.0f), u)};
    }
};

template <class Hemisphere>
void sampleHemisphere(const SamplePattern& pattern, const ReceiverSampling& sampling,
                      RayStream& rays) {
    PRT_ASSERT(pattern.reversedX.size() == rays.size(),
               "the stream has a ray for each point of the pattern");
    const Lanes d;
    const BitLanes bitLanes;

    // An orthonormal frame about the normal [Duff17].
    const Vec3f n = sampling.normal;
    const float sign = n.z < 0.0f ? -1.0f : 1.0f;
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    const Vec3f tangent(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    const Vec3f bitangent(b, sign + n.y * n.y * a, -n.y);

    const auto rotate = [&](const Direction& local, int axis) HWY_ATTR {
        const Vector flat = hn::MulAdd(local.x, hn::Set(d, tangent[axis]),
                                       hn::Mul(local.y, hn::Set(d, bitangent[axis])));
        return hn::MulAdd(local.z, hn::Set(d, n[axis]), flat);
    };
    for (std::size_t i = 0; i < rays.size(); i += hn::Lanes(d)) {
        const BitVector x = hn::LoadU(bitLanes, pattern.reversedX.data() + i);
        const BitVector y = hn::LoadU(bitLanes, pattern.reversedY.data() + i);
        const Direction local =
            Hemisphere::map(unitFromBits(reverseBitLanes(scrambleLanes(x, sampling.seedX))),
                            unitFromBits(reverseBitLanes(scrambleLanes(y, sampling.seedY))));
        hn::StoreU(rotate(local, 0), d, rays.directionX.data() + i);
        hn::StoreU(rotate(local, 1), d, rays.directionY.data() + i);
        hn::StoreU(rotate(local, 2), d, rays.directionZ.data() + i);
    }
}

void sampleDirections(const SamplePattern& pattern, const ReceiverSampling& sampling,
                      RayStream& rays) {
    sampleHemisphere<CosineHemisphere>(pattern, sampling, rays);
}

void sampleUniformDirections(const SamplePattern& pattern, const ReceiverSampling& sampling,
                             RayStream& rays) {
    sampleHemisphere<UniformHemisphere>(pattern, sampling, rays);
}

template <int kBandCount>
void sumVisibleBands(const RayStream& rays, std::span<float> sums) {
    const Lanes d;
    Vector partial[kBandCount * kBandCount];
    for (Vector& sum : partial)
        sum = hn::Zero(d);
    for (std::size_t i = 0; i < rays.size(); i += hn::Lanes(d)) {
        const auto visible = hn::Gt(hn::LoadU(d, rays.tFar.data() + i), hn::Zero(d));
        const Vector x = hn::LoadU(d, rays.directionX.data() + i);
        const Vector y = hn::LoadU(d, rays.directionY.data() + i);
        const Vector z = hn::LoadU(d, rays.directionZ.data() + i);
        evaluateShLanes<kBandCount>(d, x, y, z, [&](int index, Vector value) HWY_ATTR {
            partial[index] = hn::Add(partial[index], hn::IfThenElseZero(visible, value));
        });
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] = hn::GetLane(hn::SumOfLanes(d, partial[i]));
}

void sumVisible(const RayStream& rays, int bandCount, std::span<float> sums) {
    using SumBands = void (*)(const RayStream&, std::span<float>);
    constexpr std::array<SumBands, kMaxBandCount> kSumBands = {
        sumVisibleBands<1>, sumVisibleBands<2>, sumVisibleBands<3>, sumVisibleBands<4>,
        sumVisibleBands<5>, sumVisibleBands<6>, sumVisibleBands<7>, sumVisibleBands<8>,
        sumVisibleBands<9>, sumVisibleBands<10>};
    PRT_ASSERT(sums.size() == static_cast<std::size_t>(shCoefficientCount(bandCount)),
               "one sum a coefficient");
    kSumBands[static_cast<std::size_t>(bandCount - 1)](rays, sums);
}

// The rows that entries point at lie all over memory: ask for them this many entries ahead.
constexpr std::size_t kPrefetchDistance = 6;

/// One row times kVectors vectors of the transfer it points at, from number `first` on.
template <int kVectors>
HWY_INLINE void multiplyRowBlock(std::span<const BounceEntry> row, const BounceTransfer& transfer,
                                 std::size_t first, float* result) {
    static_assert(sizeof(BounceEntry) == 16 && offsetof(BounceEntry, weight) == 4,
                  "an entry is one 128-bit block");
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    const std::size_t stride = transfer.columnCount;

    // Each lane takes the weight of its channel from the entry's block: number 0 is the receiver, 1
    // to 3 are weights.
    HWY_ALIGN std::int32_t laneChannels[kLaneMultiple];
    decltype(hn::SetTableIndices(d, laneChannels)) channels[kVectors];
    Vector sums[kVectors];
    for (std::size_t k = 0; k < kVectors; ++k) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::size_t column = transfer.firstColumn + first + k * lanes + lane;
            laneChannels[lane] = static_cast<std::int32_t>(
                1 + std::min<std::size_t>(2, column / transfer.coefficientCount));
        }
        channels[k] = hn::SetTableIndices(d, laneChannels);
        sums[k] = hn::Zero(d);
    }

    for (std::size_t i = 0; i < row.size(); ++i) {
        const float* later =
            transfer.values +
            stride * row[std::min(i + kPrefetchDistance, row.size() - 1)].receiver + first;
        for (std::size_t k = 0; k < kVectors * lanes; k += kLaneMultiple)
            hwy::Prefetch(later + k);
        const float* source = transfer.values + stride * row[i].receiver + first;
        const Vector block = hn::LoadDup128(d, reinterpret_cast<const float*>(&row[i]));
        for (std::size_t k = 0; k < kVectors; ++k)
            sums[k] = hn::MulAdd(hn::TableLookupLanes(block, channels[k]),
                                 hn::Load(d, source + k * lanes), sums[k]);
    }
    for (std::size_t k = 0; k < kVectors; ++k)
        hn::Store(sums[k], d, result + first + k * lanes);
}

void multiplyRow(std::span<const BounceEntry> row, const BounceTransfer& transfer, float* result) {
    const std::size_t lanes = hn::Lanes(Lanes());
    const std::size_t stride = transfer.columnCount;
    std::size_t first = 0;
    for (; first + 5 * lanes <= stride; first += 5 * lanes)
        multiplyRowBlock<5>(row, transfer, first, result);
    for (; first + 2 * lanes <= stride; first += 2 * lanes)
        multiplyRowBlock<2>(row, transfer, first, result);
    for (; first < stride; first += lanes)
        multiplyRowBlock<1>(row, transfer, first, result);
}

template <int kVectors>
HWY_INLINE void addProductBlock(std::span<const float> factors, const float* rows,
                                std::size_t columnCount, float* sums) {
    const Lanes d;
    const std::size_t lanes = hn::Lanes(d);
    Vector partial[kVectors];
    for (std::size_t k = 0; k < kVectors; ++k)
        partial[k] = hn::LoadU(d, sums + k * lanes);
    for (const float factor : factors) {
        if (factor != 0.0f) {  // diffuse surfaces have one that is not
            const Vector weight = hn::Set(d, factor);
            for (std::size_t k = 0; k < kVectors; ++k)
                partial[k] = hn::MulAdd(weight, hn::LoadU(d, rows + k * lanes), partial[k]);
        }
        rows += columnCount;
    }
    for (std::size_t k = 0; k < kVectors; ++k)
        hn::StoreU(partial[k], d, sums + k * lanes);
}

void addProduct(std::span<const float> factors, const float* rows, std::size_t columnCount,
                float* sums) {
    const std::size_t lanes = hn::Lanes(Lanes());
    const std::size_t end = padToLanes(columnCount);
    std::size_t first = 0;
    for (; first + 4 * lanes <= end; first += 4 * lanes)
        addProductBlock<4>(factors, rows + first, columnCount, sums + first);
    for (; first + 2 * lanes <= end; first += 2 * lanes)
        addProductBlock<2>(factors, rows + first, columnCount, sums + first);
    for (; first < end; first += lanes)
        addProductBlock<1>(factors, rows + first, columnCount, sums + first);
}

void addOuterProduct(std::span<const float> factors, std::span<const float> addend, float* sums) {
    const Lanes d;
    for (const float factor : factors) {
        const Vector weight = hn::Set(d, factor);
        for (std::size_t j = 0; j < addend.size(); j += hn::Lanes(d))
            hn::StoreU(hn::MulAdd(weight, hn::LoadU(d, addend.data() + j), hn::LoadU(d, sums + j)),
                       d, sums + j);
        sums += addend.size();
    }
}

}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace prt {

HWY_EXPORT(sampleDirections);
HWY_EXPORT(sampleUniformDirections);
HWY_EXPORT(sumVisible);
HWY_EXPORT(multiplyRow);
HWY_EXPORT(addProduct);
HWY_EXPORT(addOuterProduct);

SamplePattern::SamplePattern(std::size_t sampleCount)
    : reversedX(sampleCount), reversedY(sampleCount) {
    PRT_ASSERT(sampleCount % kLaneMultiple == 0, "the pattern fills its vectors");
    for (std::uint32_t i = 0; i < sampleCount; ++i) {
        const SquareBits point = sobolPoint(i);
        reversedX[i] = reverseBits(point.x);
        reversedY[i] = reverseBits(point.y);
    }
}

GatherKernels selectGatherKernels(Isa isa) {
    constexpr std::array<std::int64_t, 3> kTargets = {HWY_SSE4, HWY_AVX2, HWY_AVX3};
    // The best compiled target that is no wider than asked for. Highway's
    // lower bits are its wider targets.
    hwy::ChosenTarget target;
    target.Update(hwy::SupportedTargets() & ~(kTargets[static_cast<std::size_t>(isa)] - 1));
    const std::size_t index = target.GetIndex();
    return {HWY_DISPATCH_TABLE(sampleDirections)[index],
            HWY_DISPATCH_TABLE(sampleUniformDirections)[index],
            HWY_DISPATCH_TABLE(sumVisible)[index],
            HWY_DISPATCH_TABLE(multiplyRow)[index],
            HWY_DISPATCH_TABLE(addProduct)[index],
            HWY_DISPATCH_TABLE(addOuterProduct)[index]};
}

}  // namespace prt
#endif  // HWY_ONCE
