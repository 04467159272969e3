#include "prt/relight/reflect_kernel.h"

#include <algorithm>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "prt/relight/reflect_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <hwy/contrib/math/math-inl.h>

#include "prt/basis/sh.h"
#include "prt/relight/incident_order.h"
#include "prt/relight/relight_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {
namespace {

constexpr std::size_t kBlock = kReflectBlockSize;
static_assert(kMaxBandCount <= kBlock);
constexpr float kDielectricF0 = 0.04f;

/// Where a block's receivers see the eye.
struct BlockViews {
    HWY_ALIGN float positions[kBlock];        ///< among a table's views, 0 to 1
    HWY_ALIGN float cosines[kBlock][kBlock];  ///< [receiver][m]: cos mφ
    HWY_ALIGN float sines[kBlock][kBlock];
};

struct VectorXyz {
    Vector x, y, z;
};

HWY_INLINE Vector dotXyz(const VectorXyz& a, const VectorXyz& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

/// ω_o in the receivers' frames (frameFromNormal).
HWY_INLINE VectorXyz localView(const float* places, const Vec3f& eye) {
    const FloatTag d;
    const auto load = [&](std::size_t row) HWY_ATTR { return hn::Load(d, places + row * kBlock); };
    const Vector one = hn::Set(d, 1.0f);
    VectorXyz toEye = {hn::Sub(hn::Set(d, eye.x), load(0)), hn::Sub(hn::Set(d, eye.y), load(1)),
                       hn::Sub(hn::Set(d, eye.z), load(2))};
    const VectorXyz normal = {load(3), load(4), load(5)};
    const Vector length = hn::Sqrt(dotXyz(toEye, toEye));
    const Vector scale = hn::IfThenElseZero(hn::Gt(length, hn::Zero(d)), hn::Div(one, length));
    toEye = {hn::Mul(toEye.x, scale), hn::Mul(toEye.y, scale), hn::Mul(toEye.z, scale)};

    const Vector sign = hn::CopySign(one, normal.z);
    const Vector a = hn::Neg(hn::Div(one, hn::Add(sign, normal.z)));
    const Vector xa = hn::Mul(normal.x, a);
    const Vector b = hn::Mul(xa, normal.y);
    const VectorXyz tangent = {hn::MulAdd(hn::Mul(sign, normal.x), xa, one), hn::Mul(sign, b),
                               hn::Neg(hn::Mul(sign, normal.x))};
    const VectorXyz bitangent = {b, hn::MulAdd(hn::Mul(normal.y, normal.y), a, sign),
                                 hn::Neg(normal.y)};
    return {dotXyz(toEye, tangent), dotXyz(toEye, bitangent), dotXyz(toEye, normal)};
}

/// placeView, and cos mφ and sin mφ.
void placeViews(const float* places, const Vec3f& eye, int bandCount, BlockViews& views) {
    const FloatTag d;
    const Vector one = hn::Set(d, 1.0f);
    HWY_ALIGN float cosines[kMaxBandCount][kBlock];
    HWY_ALIGN float sines[kMaxBandCount][kBlock];
    const auto orderCount = static_cast<std::size_t>(bandCount);
    for (std::size_t lane = 0; lane < kBlock; lane += hn::Lanes(d)) {
        const VectorXyz view = localView(places + lane, eye);
        const Vector z = hn::Min(hn::Max(view.z, hn::Zero(d)), one);
        const Vector rest =
            hn::Mul(hn::Asin(d, z), hn::Set(d, 2.0f * std::numbers::inv_pi_v<float>));
        hn::Store(hn::Max(hn::Sub(one, hn::Sqrt(rest)), hn::Zero(d)), d, views.positions + lane);

        const Vector radius = hn::Sqrt(hn::MulAdd(view.x, view.x, hn::Mul(view.y, view.y)));
        const auto isAside = hn::Gt(radius, hn::Zero(d));
        const Vector stepCosine = hn::IfThenElse(isAside, hn::Div(view.x, radius), one);
        const Vector stepSine = hn::IfThenElseZero(isAside, hn::Div(view.y, radius));
        Vector cosine = one;
        Vector sine = hn::Zero(d);
        hn::Store(cosine, d, &cosines[0][lane]);
        hn::Store(sine, d, &sines[0][lane]);
        for (std::size_t m = 1; m < orderCount; ++m) {
            const Vector next = hn::NegMulAdd(sine, stepSine, hn::Mul(cosine, stepCosine));
            sine = hn::MulAdd(cosine, stepSine, hn::Mul(sine, stepCosine));
            cosine = next;
            hn::Store(cosine, d, &cosines[m][lane]);
            hn::Store(sine, d, &sines[m][lane]);
        }
    }
    for (std::size_t receiver = 0; receiver < kBlock; ++receiver)
        for (std::size_t m = 0; m < orderCount; ++m) {
            views.cosines[receiver][m] = cosines[m][receiver];
            views.sines[receiver][m] = sines[m][receiver];
        }
}

/// Results of a receiver, lane by lane: perBaseColor, constant, and of a split one what arrives of
/// white light and what would unshadowed.
using LobeSums = Vector[8];

/// A receiver and one view of it.
struct ViewedLobe {
    const ReceiverLobe& lobe;
    const float* cosines = nullptr;
    const float* sines = nullptr;
    const float* incident = nullptr;
    std::size_t firstView = 0;  ///< of the table's
    float viewShare = 0.0f;     ///< of the next
};

/// Picks the factor of each lane.
HWY_INLINE Vector lookUp(const float* factors, const std::int32_t* orders) {
    const FloatTag d;
    const auto indices = hn::Load(hn::RebindToSigned<FloatTag>(), orders);
    if constexpr (hn::MaxLanes(d) == kBlock)
        return hn::TableLookupLanes(hn::Load(d, factors), hn::IndicesFromVec(d, indices));
    else
        return hn::GatherIndex(d, factors, indices);
}

/// Turns incident radiance about the normal, a vector of coefficients of m ≥ 0, until the view is
/// at azimuth 0: cos mφ l_(l,m) + sin mφ l_(l,−m).
struct Turn {
    Vector cosine, sine;
    std::size_t lane = 0;
    std::size_t partner = 0;

    HWY_INLINE Turn(const ReflectView& receivers, const ViewedLobe& viewed, std::size_t lane_)
        : cosine(lookUp(viewed.cosines, receivers.orders + lane_)),
          sine(lookUp(viewed.sines, receivers.orders + lane_)),
          lane(lane_),
          partner(lane_ + pairCount(receivers.bandCount)) {}

    HWY_INLINE Vector operator()(const float* incident) const {
        const FloatTag d;
        return hn::MulAdd(cosine, hn::LoadU(d, incident + lane),
                          hn::Mul(sine, hn::LoadU(d, incident + partner)));
    }
};

HWY_INLINE void addTo(Vector& sum, Vector response, Vector incident) {
    sum = hn::MulAdd(response, incident, sum);
}

template <bool kSplit>
HWY_INLINE void reflectGltf(const ReflectView& receivers, const ViewedLobe& viewed,
                            LobeSums& sums) {
    const FloatTag d;
    const std::size_t size = receivers.uprightSize;
    const std::size_t levelSize = viewed.lobe.viewCount * 2 * size;
    const float* const low = viewed.lobe.rows + viewed.firstView * 2 * size;
    const float* const diffuseRow = receivers.diffuse + viewed.firstView * size;
    const float level = viewed.lobe.levelShare;
    const Vector above = hn::Set(d, viewed.viewShare);
    const Vector below = hn::Set(d, 1.0f - viewed.viewShare);
    const Vector lowBelow = hn::Set(d, (1.0f - level) * (1.0f - viewed.viewShare));
    const Vector lowAbove = hn::Set(d, (1.0f - level) * viewed.viewShare);
    const Vector highBelow = hn::Set(d, level * (1.0f - viewed.viewShare));
    const Vector highAbove = hn::Set(d, level * viewed.viewShare);
    const auto blend = [&](const float* row) HWY_ATTR {
        const Vector atLow =
            hn::MulAdd(lowAbove, hn::Load(d, row + 2 * size), hn::Mul(lowBelow, hn::Load(d, row)));
        return hn::MulAdd(highAbove, hn::Load(d, row + levelSize + 2 * size),
                          hn::MulAdd(highBelow, hn::Load(d, row + levelSize), atLow));
    };
    const float metallicShare = viewed.lobe.metallic;
    const Vector metallic = hn::Set(d, metallicShare);
    const Vector coat = hn::Set(d, kDielectricF0 * (1.0f - metallicShare));
    const Vector base = hn::Set(d, (1.0f - kDielectricF0) * (1.0f - metallicShare));

    for (std::size_t lane = 0; lane < size; lane += hn::Lanes(d)) {
        const Turn turn(receivers, viewed, lane);
        const Vector dark = blend(low + lane);
        const Vector range = blend(low + size + lane);
        const Vector layered =
            hn::Mul(base, hn::MulAdd(above, hn::Load(d, diffuseRow + size + lane),
                                     hn::Mul(below, hn::Load(d, diffuseRow + lane))));
        const Vector constant = hn::MulAdd(coat, range, dark);
        if constexpr (!kSplit) {
            const Vector perBaseColor = hn::MulAdd(metallic, range, layered);
            for (std::size_t c = 0; c < 3; ++c) {
                const Vector all = turn(viewed.incident + c * receivers.rowSize);
                addTo(sums[c], perBaseColor, all);
                addTo(sums[3 + c], constant, all);
            }
        } else {
            for (std::size_t c = 0; c < 3; ++c) {
                addTo(sums[c], layered, turn(viewed.incident + c * receivers.rowSize));
                if (!receivers.hasBounced) continue;
                const Vector bounced = turn(viewed.incident + (3 + c) * receivers.rowSize);
                addTo(sums[c], hn::Mul(metallic, range), bounced);
                addTo(sums[3 + c], constant, bounced);
            }
            const Vector bright = hn::Add(dark, range);
            addTo(sums[6], bright, turn(viewed.lobe.arriving));
            addTo(sums[7], bright, hn::Load(d, receivers.open + lane));
        }
    }
}

HWY_INLINE void reflectOther(const ReflectView& receivers, const ViewedLobe& viewed,
                             LobeSums& sums) {
    const FloatTag d;
    const std::size_t size = receivers.uprightSize;
    const float* const row = viewed.lobe.rows + viewed.firstView * 3 * size;
    const Vector above = hn::Set(d, viewed.viewShare);
    const Vector below = hn::Set(d, 1.0f - viewed.viewShare);
    for (std::size_t lane = 0; lane < size; lane += hn::Lanes(d)) {
        const Turn turn(receivers, viewed, lane);
        for (std::size_t c = 0; c < 3; ++c) {
            const float* const at = row + c * size + lane;
            const Vector response =
                hn::MulAdd(above, hn::Load(d, at + 3 * size), hn::Mul(below, hn::Load(d, at)));
            addTo(sums[3 + c], response, turn(viewed.incident + c * receivers.rowSize));
        }
    }
}

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE void sumLanes(const LobeSums& sums, float* totals) {
    for (std::size_t k = 0; k < 8; ++k)
        totals[k] = hn::GetLane(sums[k]);
}
#else
/// Adds up four vectors, a 128-bit part at a time: in each part a, b, c, d.
HWY_INLINE Vector sumParts(Vector a, Vector b, Vector c, Vector e) {
    const FloatTag d;
    const hn::Repartition<double, FloatTag> pairs;
    const Vector ab = hn::Add(hn::InterleaveLower(d, a, b), hn::InterleaveUpper(d, a, b));
    const Vector ce = hn::Add(hn::InterleaveLower(d, c, e), hn::InterleaveUpper(d, c, e));
    const auto abPairs = hn::BitCast(pairs, ab);
    const auto cePairs = hn::BitCast(pairs, ce);
    return hn::Add(hn::BitCast(d, hn::InterleaveLower(pairs, abPairs, cePairs)),
                   hn::BitCast(d, hn::InterleaveUpper(pairs, abPairs, cePairs)));
}

/// And the parts.
template <class D>
HWY_INLINE void addParts(D d, hn::Vec<D> parts, float* totals) {
    if constexpr (hn::MaxLanes(D()) <= 4) {
        hn::StoreU(parts, d, totals);
    } else {
        const hn::Half<D> half;
        addParts(half, hn::Add(hn::LowerHalf(half, parts), hn::UpperHalf(half, parts)), totals);
    }
}

HWY_INLINE void sumLanes(const LobeSums& sums, float* totals) {
    const FloatTag d;
    addParts(d, sumParts(sums[0], sums[1], sums[2], sums[3]), totals);
    addParts(d, sumParts(sums[4], sums[5], sums[6], sums[7]), totals + 4);
}
#endif

HWY_INLINE ExitRadiance reflectReceiver(const ReflectView& receivers, const ViewedLobe& viewed) {
    const Vector zero = hn::Zero(FloatTag());
    LobeSums sums = {zero, zero, zero, zero, zero, zero, zero, zero};
    switch (viewed.lobe.kind) {
        case LobeKind::gltf:
            reflectGltf<false>(receivers, viewed, sums);
            break;
        case LobeKind::split:
            reflectGltf<true>(receivers, viewed, sums);
            break;
        case LobeKind::other:
            reflectOther(receivers, viewed, sums);
    }
    HWY_ALIGN float totals[8];
    sumLanes(sums, totals);
    return {{totals[0], totals[1], totals[2]},
            {totals[3], totals[4], totals[5]},
            totals[7] > 0.0f ? std::clamp(totals[6] / totals[7], 0.0f, 1.0f) : 0.0f};
}

void reflect(const ReflectView& receivers, const Vec3f& eye, const float* incident,
             std::span<const std::byte> ahead, std::span<ExitRadiance> radiance) {
    // More than that is not there any sooner.
    constexpr std::size_t kMostAhead = std::size_t{12} << 10;
    const std::size_t askedBytes = std::min(kMostAhead, ahead.size()) / kBlock;
    BlockViews views;
    for (std::size_t r = 0; r < radiance.size(); ++r) {
        const std::size_t inBlock = r % kBlock;
        if (inBlock == 0) placeViews(receivers.places + 6 * r, eye, receivers.bandCount, views);
        askFor(ahead.data() + inBlock * askedBytes, askedBytes);
        const ReceiverLobe& lobe = receivers.lobes[r];
        const float position = views.positions[inBlock] * static_cast<float>(lobe.viewCount - 1);
        const auto firstView = std::min(static_cast<std::int32_t>(position),
                                        static_cast<std::int32_t>(lobe.viewCount) - 2);
        radiance[r] = reflectReceiver(
            receivers, {lobe, views.cosines[inBlock], views.sines[inBlock],
                        incident + r * receivers.incidentSize, static_cast<std::size_t>(firstView),
                        position - static_cast<float>(firstView)});
    }
}

}  // namespace
}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace prt {

HWY_EXPORT(reflect);

void reflectIncident(const ReflectView& receivers, const Vec3f& eye, const float* incident,
                     std::span<const std::byte> ahead, std::span<ExitRadiance> radiance) {
    HWY_DYNAMIC_DISPATCH(reflect)(receivers, eye, incident, ahead, radiance);
}

}  // namespace prt
#endif  // HWY_ONCE
