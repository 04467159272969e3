// Bibliography
//   [Sloan08]   Stupid spherical harmonics tricks
//   [Sloan13]   Efficient spherical harmonic evaluation
//   [Holmes02]  Normalised recurrences of associated Legendre functions of very high degree
#include "prt/basis/sh.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "prt/base/assert.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "prt/basis/sh.cpp"
#include <hwy/foreach_target.h>

#include "prt/basis/sh-inl.h"

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {
namespace {

/// Evaluates some directions; function i in direction j goes to values[i·kDirectionCount + j].
template <int kBandCount, std::size_t kDirectionCount, class Real>
void evaluateDirections(const Real* x, const Real* y, const Real* z, Real* values) {
    const hn::CappedTag<Real, kDirectionCount> d;
    for (std::size_t j = 0; j < kDirectionCount; j += hn::Lanes(d)) {
        Real* const destination = values + j;
        evaluateShLanes<kBandCount>(
            d, hn::LoadU(d, x + j), hn::LoadU(d, y + j), hn::LoadU(d, z + j),
            [d, destination](int index, auto value) HWY_ATTR {
                hn::StoreU(value, d,
                           destination + kDirectionCount * static_cast<std::size_t>(index));
            });
    }
}

/// Picks the straight-line code of the band count, which is at most kMaxBandCount.
template <std::size_t kDirectionCount, class Real, int... kLower>
void dispatchBandCount(std::integer_sequence<int, kLower...>, int bandCount, const Real* x,
                       const Real* y, const Real* z, Real* values) {
    ((bandCount == kLower + 1 ? evaluateDirections<kLower + 1, kDirectionCount>(x, y, z, values)
                              : void()),
     ...);
}

using BandCounts = std::make_integer_sequence<int, kMaxBandCount>;

void evaluateBatch(int bandCount, const float* x, const float* y, const float* z, float* values) {
    dispatchBandCount<kShBatchSize>(BandCounts(), bandCount, x, y, z, values);
}

// One direction gains nothing from wide vectors; one build of it gives the same bits everywhere.
#if HWY_TARGET == HWY_STATIC_TARGET
template <class Real>
void evaluateOne(const Imath::Vec3<Real>& direction, int bandCount, Real* values) {
    dispatchBandCount<1>(BandCounts(), bandCount, &direction.x, &direction.y, &direction.z, values);
}
#endif

}  // namespace
}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace prt {

HWY_EXPORT(evaluateBatch);

namespace {

/// The step from p_l and p_{l−1} to p_{l+1}, of one order.
struct LegendreStep {
    double last;        ///< times z p_l
    double beforeLast;  ///< times p_{l−1}, subtracted
};

/// The steps of all orders m < n from all degrees l ≥ m, at n·m + l.
std::vector<LegendreStep> makeLegendreSteps(int bandCount) {
    const auto n = static_cast<std::size_t>(bandCount);
    std::vector<LegendreStep> steps(n * n);
    for (std::size_t m = 0; m < n; ++m) {
        double lastFactor = 0.0;
        for (std::size_t l = m; l < n; ++l) {
            const double next = static_cast<double>(l) + 1.0, order = static_cast<double>(m);
            const double factor =
                std::sqrt((4.0 * next * next - 1.0) / (next * next - order * order));
            steps[n * m + l] = {factor, l > m ? factor / lastFactor : 0.0};
            lastFactor = factor;
        }
    }
    return steps;
}

/// Any band count: the recurrence of [Holmes02] on p_lm sin^m θ, which is bounded by √((2l+1)/2π),
/// so that nothing overflows.
///
/// @param steps  of stepBandCount bands, no fewer than bandCount
template <class Real>
void evaluateAnyBandCount(const Imath::Vec3<Real>& direction, int bandCount,
                          std::span<const LegendreStep> steps, int stepBandCount, Real* values) {
    const double x = direction.x, y = direction.y, z = direction.z;
    const double sinTheta = std::hypot(x, y);
    const double cosPhi = sinTheta > 0.0 ? x / sinTheta : 1.0;
    const double sinPhi = sinTheta > 0.0 ? y / sinTheta : 0.0;

    double cosine = 1.0, sine = 0.0;                   // of m φ
    double sectoral = 0.5 * std::numbers::inv_sqrtpi;  // p_mm sin^m θ with its sign
    for (int m = 0; m < bandCount; ++m) {
        const LegendreStep* const stepOf = steps.data() + stepBandCount * m;
        double last = 0.0, legendre = sectoral;
        for (int l = m; l < bandCount; ++l) {
            values[shIndex(l, m)] = static_cast<Real>(legendre * cosine);
            if (m > 0) values[shIndex(l, -m)] = static_cast<Real>(legendre * sine);
            const double beforeLast = std::exchange(last, legendre);
            legendre = stepOf[l].last * z * last - stepOf[l].beforeLast * beforeLast;
        }
        const double nextCosine = cosPhi * cosine - sinPhi * sine;
        sine = cosPhi * sine + sinPhi * cosine;
        cosine = nextCosine;
        sectoral *= -sinTheta * std::sqrt(m == 0 ? 3.0 : (2.0 * m + 3.0) / (2.0 * m + 2.0));
    }
}

template <class Real>
void evaluateAnyBandCount(const Imath::Vec3<Real>& direction, int bandCount, Real* values) {
    constexpr int kTabulatedBandCount = 64;
    static const std::vector<LegendreStep> kSteps = makeLegendreSteps(kTabulatedBandCount);
    if (bandCount <= kTabulatedBandCount)
        evaluateAnyBandCount(direction, bandCount, kSteps, kTabulatedBandCount, values);
    else
        evaluateAnyBandCount(direction, bandCount, makeLegendreSteps(bandCount), bandCount, values);
}

void checkSizes(int bandCount, std::size_t valueCount, std::size_t directionCount) {
    PRT_ASSERT(bandCount >= 1, "there is at least one band");
    PRT_ASSERT(
        valueCount == directionCount * static_cast<std::size_t>(shCoefficientCount(bandCount)),
        "there is room for one value a function and direction");
}

template <class Real>
void evaluate(const Imath::Vec3<Real>& direction, int bandCount, std::span<Real> values) {
    checkSizes(bandCount, values.size(), 1);
    if (bandCount <= kMaxBandCount) {
        HWY_STATIC_DISPATCH(evaluateOne)(direction, bandCount, values.data());
    } else {
        evaluateAnyBandCount(direction, bandCount, values.data());
    }
}

}  // namespace

void evaluateSh(const Vec3d& direction, int bandCount, std::span<double> values) {
    evaluate(direction, bandCount, values);
}

void evaluateSh(const Vec3f& direction, int bandCount, std::span<float> values) {
    evaluate(direction, bandCount, values);
}

void evaluateShBatch(std::span<const float, kShBatchSize> x, std::span<const float, kShBatchSize> y,
                     std::span<const float, kShBatchSize> z, int bandCount,
                     std::span<float> values) {
    checkSizes(bandCount, values.size(), kShBatchSize);
    PRT_ASSERT(bandCount <= kMaxBandCount, "straight-line code exists for this band count");
    HWY_DYNAMIC_DISPATCH(evaluateBatch)(bandCount, x.data(), y.data(), z.data(), values.data());
}

void sumShBands(std::span<const double> coefficients, std::span<const double> basis,
                std::span<double> bands) {
    PRT_ASSERT(
        coefficients.size() == bands.size() * bands.size() && basis.size() == coefficients.size(),
        "n² coefficients and functions of n bands");
    std::size_t i = 0;
    for (std::size_t l = 0; l < bands.size(); ++l) {
        bands[l] = 0.0;
        for (; i < (l + 1) * (l + 1); ++i)
            bands[l] += coefficients[i] * basis[i];
    }
}

double reconstructSh(std::span<const double> coefficients, int bandCount, const Vec3d& direction) {
    std::vector<double> values(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    evaluateSh(direction, bandCount, values);
    PRT_ASSERT(coefficients.size() == values.size(), "there is one coefficient a function");
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i)
        sum += coefficients[i] * values[i];
    return sum;
}

}  // namespace prt
#endif  // HWY_ONCE
