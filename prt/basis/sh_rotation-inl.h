// Rotation of spherical harmonics by turns about z, one function a vector lane [Dachsbacher17,
// Pinchon07]; see rotateSh. Included once a target from files that hwy/foreach_target.h compiles
// again and again.

#if defined(PRT_BASIS_SH_ROTATION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PRT_BASIS_SH_ROTATION_INL_H_
#undef PRT_BASIS_SH_ROTATION_INL_H_
#else
#define PRT_BASIS_SH_ROTATION_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <limits>
#include <numbers>

#include "prt/basis/sh-inl.h"

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {

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

template <class V>
HWY_INLINE void computeMultiples(int bandCount, Turns<V>& turns) {
    computeMultiples<2>(bandCount, turns.alpha);
    computeMultiples<2>(bandCount, turns.minusBeta);
    computeMultiples<2>(bandCount, turns.gamma);
}

/// Finds the three turns of an orthogonal matrix r, row-major.
///
/// γ turns into the plane of y and z what becomes z; where that lies in the pole, any γ will do. α
/// is read off what is left when γ is undone, and so makes good what rounding did to γ near the
/// pole.
template <class D, class V>
HWY_INLINE Turns<V> findTurns(D d, const V (&r)[9]) {
    using Real = hn::TFromD<D>;
    const V determinant =
        hn::MulAdd(r[6], hn::MulSub(r[1], r[5], hn::Mul(r[2], r[4])),
                   hn::MulAdd(r[7], hn::MulSub(r[2], r[3], hn::Mul(r[0], r[5])),
                              hn::Mul(r[8], hn::MulSub(r[0], r[4], hn::Mul(r[1], r[3])))));
    const V one = hn::Set(d, Real(1));
    const V sign = hn::CopySign(one, determinant);

    // A root and a quotient at once are faster than one after the other.
    const V square = hn::MulAdd(r[6], r[6], hn::Mul(r[7], r[7]));
    const auto isPole = hn::Lt(square, hn::Set(d, std::numeric_limits<Real>::min()));
    const V sinBeta = hn::Sqrt(square);
    const V scale = hn::Mul(sinBeta, hn::Div(one, square));
    const V sinGamma = hn::IfThenZeroElse(isPole, hn::Mul(scale, hn::Mul(sign, r[6])));
    const V cosGamma = hn::IfThenElse(isPole, one, hn::Mul(scale, hn::Mul(sign, r[7])));

    Turns<V> turns;
    turns.sign = sign;
    turns.gamma.cosine[1] = cosGamma;
    turns.gamma.sine[1] = sinGamma;
    turns.minusBeta.cosine[1] = hn::Mul(sign, r[8]);
    turns.minusBeta.sine[1] = hn::Neg(sinBeta);
    turns.alpha.cosine[1] = hn::Mul(sign, hn::MulSub(cosGamma, r[0], hn::Mul(sinGamma, r[1])));
    turns.alpha.sine[1] = hn::Mul(sign, hn::MulSub(cosGamma, r[3], hn::Mul(sinGamma, r[4])));
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

}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // PRT_BASIS_SH_ROTATION_INL_H_
