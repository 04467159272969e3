// Bibliography
//   [Dachsbacher17]  Precomputed radiance transfer
//   [Pinchon07]      Rotation matrices for real spherical harmonics
#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "prt/base/assert.h"
#include "prt/basis/sh_rotation.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "prt/basis/sh_rotation_kernel.cpp"
#include <hwy/foreach_target.h>

#include "prt/basis/sh-inl.h"

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {
namespace {

constexpr double binomial(int n, int k) {
    double product = k >= 0 && k <= n ? 1.0 : 0.0;
    for (int i = 0; i < k && i < n; ++i)
        product = product * (n - i) / (i + 1);
    return product;
}

/// Wigner's d^l_{mk}(π/2): how complex harmonics mix under a quarter turn about y.
constexpr double quarterTurnEntry(int l, int m, int k) {
    double sum = 0.0;
    for (int s = 0; s <= l + k; ++s)
        sum += (s % 2 == 0 ? 1.0 : -1.0) * binomial(l + k, s) * binomial(l - k, l - m - s);
    const double root = constantSqrt(binomial(2 * l, l + k) / binomial(2 * l, l + m));
    return ((m - k) % 2 == 0 ? 1.0 : -1.0) * root * sum / (1 << l);
}

/// Entry (m, k) of the block of degree l of E, which exchanges z and x: a quarter turn about y, and
/// then z to −z. It is zero where m and k differ in sign, and in every second place elsewhere.
constexpr double exchangeEntry(int l, int m, int k) {
    const int row = m < 0 ? -m : m, column = k < 0 ? -k : k;
    const double sign = ((l + row) % 2 == 0 ? 1.0 : -1.0);
    const double entry = quarterTurnEntry(l, row, column);
    if (row == 0 && column == 0) return sign * entry;
    if (row == 0 || column == 0) return sign * std::numbers::sqrt2 * entry;
    const double mirrored = (column % 2 == 0 ? 1.0 : -1.0) * quarterTurnEntry(l, row, -column);
    return sign * (m < 0 ? entry - mirrored : entry + mirrored);
}

/// A turn about z: cosines and sines of the multiples of its angle, from 1.
template <class V>
struct Turn {
    V cosine[kMaxBandCount];
    V sine[kMaxBandCount];
};

/// R = ±Z(α) X(β) Z(γ).
template <class V>
struct Turns {
    Turn<V> alpha, minusBeta, gamma;
    V sign;
};

/// Computes the multiples of the angle from m ≥ 2 up to bandCount − 1.
template <int m, class V>
HWY_INLINE void computeMultiples(int bandCount, Turn<V>& turn) {
    if constexpr (m < kMaxBandCount) {
        if (m >= bandCount) return;
        const V cosine = turn.cosine[m - 1], sine = turn.sine[m - 1];
        turn.cosine[m] = hn::MulSub(turn.cosine[1], cosine, hn::Mul(turn.sine[1], sine));
        turn.sine[m] = hn::MulAdd(turn.cosine[1], sine, hn::Mul(turn.sine[1], cosine));
        computeMultiples<m + 1>(bandCount, turn);
    }
}

/// Finds the three turns of an orthogonal matrix r, row-major.
///
/// α turns the image of z into the plane of y and z; where it lies in the pole, any α will do. γ is
/// read off what is left when α is undone, and so makes good what rounding did to α near the pole.
template <class D, class V>
HWY_INLINE Turns<V> findTurns(D d, const V (&r)[9], int bandCount) {
    using Real = hn::TFromD<D>;
    const V determinant =
        hn::MulAdd(r[6], hn::MulSub(r[1], r[5], hn::Mul(r[2], r[4])),
                   hn::MulAdd(r[7], hn::MulSub(r[2], r[3], hn::Mul(r[0], r[5])),
                              hn::Mul(r[8], hn::MulSub(r[0], r[4], hn::Mul(r[1], r[3])))));
    Turns<V> turns;
    turns.sign = hn::CopySign(hn::Set(d, Real(1)), determinant);

    const V square = hn::MulAdd(r[2], r[2], hn::Mul(r[5], r[5]));
    const auto isPole = hn::Lt(square, hn::Set(d, std::numeric_limits<Real>::min()));
    const V sinBeta = hn::Sqrt(square);
    const V scale = hn::Div(turns.sign, sinBeta);
    const V sinAlpha = hn::IfThenZeroElse(isPole, hn::Mul(scale, r[2]));
    const V cosAlpha = hn::IfThenElse(isPole, hn::Set(d, Real(1)), hn::Neg(hn::Mul(scale, r[5])));

    turns.alpha.cosine[1] = cosAlpha;
    turns.alpha.sine[1] = sinAlpha;
    turns.minusBeta.cosine[1] = hn::Mul(turns.sign, r[8]);
    turns.minusBeta.sine[1] = hn::Neg(sinBeta);
    turns.gamma.cosine[1] =
        hn::Mul(turns.sign, hn::MulAdd(cosAlpha, r[0], hn::Mul(sinAlpha, r[3])));
    turns.gamma.sine[1] =
        hn::Mul(hn::Neg(turns.sign), hn::MulAdd(cosAlpha, r[1], hn::Mul(sinAlpha, r[4])));
    computeMultiples<2>(bandCount, turns.alpha);
    computeMultiples<2>(bandCount, turns.minusBeta);
    computeMultiples<2>(bandCount, turns.gamma);
    return turns;
}

/// Turns a band about z. `band` is its entry m = 0.
template <int l, class V>
HWY_INLINE void turnBand(const Turn<V>& turn, V* band) {
    for (int m = 1; m <= l; ++m) {
        const V plus = band[m], minus = band[-m];
        band[m] = hn::MulSub(turn.cosine[m], plus, hn::Mul(turn.sine[m], minus));
        band[-m] = hn::MulAdd(turn.sine[m], plus, hn::Mul(turn.cosine[m], minus));
    }
}

/// Adds the products of row m of E with entries ±k, ±(k + 2), … of a band, of the sign of m.
template <int l, int m, int k, class D, class V>
HWY_INLINE V addExchanged(D d, const V* band, V sum) {
    if constexpr (k > l) {
        return sum;
    } else {
        constexpr int kColumn = m < 0 ? -k : k;
        constexpr double kEntry = exchangeEntry(l, m, kColumn);
        const V factor = hn::Set(d, static_cast<hn::TFromD<D>>(kEntry));
        return addExchanged<l, m, k + 2>(d, band, hn::MulAdd(factor, band[kColumn], sum));
    }
}

/// Rows m … l of E times a band.
template <int l, int m, class D, class V>
HWY_INLINE void exchangeAxes(D d, const V* band, V* exchanged) {
    if constexpr (m <= l) {
        constexpr int kFirst = m >= 0 ? (l + m) % 2 : 1 + (l - m) % 2;
        constexpr int kColumn = m < 0 ? -kFirst : kFirst;
        constexpr double kEntry = exchangeEntry(l, m, kColumn);
        const V first = hn::Mul(hn::Set(d, static_cast<hn::TFromD<D>>(kEntry)), band[kColumn]);
        exchanged[m] = addExchanged<l, m, kFirst + 2>(d, band, first);
        exchangeAxes<l, m + 1>(d, band, exchanged);
    }
}

/// Rotates the band of degree l ≥ 1; coefficients are kStride numbers apart.
template <std::size_t kStride, int l, class D, class V>
HWY_INLINE void rotateBand(D d, const Turns<V>& turns, const hn::TFromD<D>* source,
                           hn::TFromD<D>* rotated) {
    constexpr auto kFirst = static_cast<std::size_t>(l * l);
    V band[2 * l + 1], exchanged[2 * l + 1];
    for (std::size_t i = 0; i < 2 * l + 1; ++i) {
        band[i] = hn::LoadU(d, source + (kFirst + i) * kStride);
        if constexpr (l % 2 == 1) band[i] = hn::Mul(turns.sign, band[i]);
    }
    turnBand<l>(turns.gamma, band + l);
    exchangeAxes<l, -l>(d, band + l, exchanged + l);
    turnBand<l>(turns.minusBeta, exchanged + l);
    exchangeAxes<l, -l>(d, exchanged + l, band + l);
    turnBand<l>(turns.alpha, band + l);
    for (std::size_t i = 0; i < 2 * l + 1; ++i)
        hn::StoreU(band[i], d, rotated + (kFirst + i) * kStride);
}

/// Rotates the bands from degree l ≥ 1 up.
template <std::size_t kStride, int l, class D, class V>
HWY_INLINE void rotateBands(D d, const Turns<V>& turns, int bandCount, const hn::TFromD<D>* source,
                            hn::TFromD<D>* rotated) {
    if constexpr (l < kMaxBandCount) {
        if (l >= bandCount) return;
        rotateBand<kStride, l>(d, turns, source, rotated);
        rotateBands<kStride, l + 1>(d, turns, bandCount, source, rotated);
    }
}

void rotateBatch(int bandCount, const float* rotations, const float* source, float* rotated) {
    const hn::CappedTag<float, kShBatchSize> d;
    using V = hn::Vec<decltype(d)>;
    for (std::size_t j = 0; j < kShBatchSize; j += hn::Lanes(d)) {
        V matrix[9];
        for (std::size_t entry = 0; entry < 9; ++entry)
            matrix[entry] = hn::LoadU(d, rotations + kShBatchSize * entry + j);
        const Turns<V> turns = findTurns(d, matrix, bandCount);
        hn::StoreU(hn::LoadU(d, source + j), d, rotated + j);
        rotateBands<kShBatchSize, 1>(d, turns, bandCount, source + j, rotated + j);
    }
}

template <class Real>
HWY_INLINE void rotateChannels(const Mat3d& rotation, int bandCount, std::size_t channelCount,
                               const Real* source, Real* rotated) {
    const hn::CappedTag<Real, 1> d;
    using V = hn::Vec<decltype(d)>;
    V matrix[9];
    for (int entry = 0; entry < 9; ++entry)
        matrix[entry] = hn::Set(d, static_cast<Real>(rotation[entry / 3][entry % 3]));
    const Turns<V> turns = findTurns(d, matrix, bandCount);
    const auto channelSize = static_cast<std::size_t>(shCoefficientCount(bandCount));
    for (std::size_t i = 0; i < channelCount * channelSize; i += channelSize) {
        rotated[i] = source[i];
        rotateBands<1, 1>(d, turns, bandCount, source + i, rotated + i);
    }
}

void rotateFloats(const Mat3d& rotation, int bandCount, std::size_t channelCount,
                  const float* source, float* rotated) {
    rotateChannels(rotation, bandCount, channelCount, source, rotated);
}

void rotateDoubles(const Mat3d& rotation, int bandCount, std::size_t channelCount,
                   const double* source, double* rotated) {
    rotateChannels(rotation, bandCount, channelCount, source, rotated);
}

}  // namespace
}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace prt {

HWY_EXPORT(rotateBatch);
HWY_EXPORT(rotateFloats);
HWY_EXPORT(rotateDoubles);

namespace {

/// Checks the sizes. Returns the number of channels.
std::size_t countChannels(int bandCount, std::size_t sourceSize, std::size_t rotatedSize) {
    PRT_ASSERT(bandCount >= 1, "there is at least one band");
    const auto channelSize = static_cast<std::size_t>(shCoefficientCount(bandCount));
    PRT_ASSERT(sourceSize % channelSize == 0 && rotatedSize == sourceSize,
               "there is one coefficient a function and channel");
    return sourceSize / channelSize;
}

template <class Real>
void rotateByMatrix(const Mat3d& rotation, int bandCount, std::span<const Real> source,
                    std::span<Real> rotated) {
    const ShRotation matrix(rotation, bandCount);
    std::vector<double> channel(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    std::vector<double> turned(channel.size());
    for (std::size_t i = 0; i < source.size(); i += channel.size()) {
        std::copy_n(&source[i], channel.size(), channel.begin());
        matrix.apply(channel, turned);
        std::transform(turned.begin(), turned.end(), &rotated[i],
                       [](double value) { return static_cast<Real>(value); });
    }
}

}  // namespace

void rotateSh(const Mat3d& rotation, int bandCount, std::span<const float> source,
              std::span<float> rotated) {
    const std::size_t channelCount = countChannels(bandCount, source.size(), rotated.size());
    if (bandCount <= kMaxBandCount) {
        HWY_DYNAMIC_DISPATCH(rotateFloats)
        (rotation, bandCount, channelCount, source.data(), rotated.data());
    } else {
        rotateByMatrix(rotation, bandCount, source, rotated);
    }
}

void rotateSh(const Mat3d& rotation, int bandCount, std::span<const double> source,
              std::span<double> rotated) {
    const std::size_t channelCount = countChannels(bandCount, source.size(), rotated.size());
    if (bandCount <= kMaxBandCount) {
        HWY_DYNAMIC_DISPATCH(rotateDoubles)
        (rotation, bandCount, channelCount, source.data(), rotated.data());
    } else {
        rotateByMatrix(rotation, bandCount, source, rotated);
    }
}

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
