// Bibliography
//   [Dachsbacher17]  Precomputed radiance transfer
//   [Pinchon07]      Rotation matrices for real spherical harmonics
#include <algorithm>
#include <array>
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

/// The broadcast entries of a matrix.
template <class D>
HWY_INLINE Turns<hn::Vec<D>> findTurns(D d, const Mat3d& rotation) {
    hn::Vec<D> matrix[9];
    for (int entry = 0; entry < 9; ++entry) {
        matrix[entry] = hn::Set(d, static_cast<hn::TFromD<D>>(rotation[entry / 3][entry % 3]));
    }
    return findTurns(d, matrix);
}

/// Rotates one function after the other, in vectors of one lane.
template <class Real>
HWY_INLINE void rotateChannels(const Mat3d& rotation, int bandCount, std::size_t channelCount,
                               const Real* source, Real* rotated) {
    const hn::CappedTag<Real, 1> d;
    Turns<hn::Vec<decltype(d)>> turns = findTurns(d, rotation);
    computeMultiples(bandCount, turns);
    const auto channelSize = static_cast<std::size_t>(shCoefficientCount(bandCount));
    for (std::size_t i = 0; i < channelCount * channelSize; i += channelSize) {
        rotated[i] = source[i];
        rotateBands<1, 1>(d, turns, bandCount, source + i, rotated + i);
    }
}

void rotateDoubles(const Mat3d& rotation, int bandCount, std::size_t channelCount,
                   const double* source, double* rotated) {
    rotateChannels(rotation, bandCount, channelCount, source, rotated);
}

#if HWY_TARGET == HWY_SCALAR
void rotateFloats(const Mat3d& rotation, int bandCount, std::size_t channelCount,
                  const float* source, float* rotated) {
    rotateChannels(rotation, bandCount, channelCount, source, rotated);
}
#else
// One function of floats: a vector holds the coefficients of orders e = 2j and o = 2j + 1, as
// (c_e, c_o, c_−o, c_−e), so that a turn about z pairs each lane with its mirror image.

using Quad = hn::FixedTag<float, 4>;
using QuadVector = hn::Vec<Quad>;
constexpr int kMaxQuads = (kMaxBandCount + 1) / 2;

constexpr int quadCount(int l) {
    return l / 2 + 1;
}

/// A turn about z for each vector: cosines, and sines that are negative in the first two lanes.
struct QuadTurn {
    QuadVector cosine[kMaxQuads];
    QuadVector sine[kMaxQuads];
};

HWY_INLINE QuadVector setQuad(float a, float b, float c, float e) {
    HWY_ALIGN const float lanes[4] = {a, b, c, e};
    return hn::Load(Quad(), lanes);
}

/// Orders 0 and 1, and then the next two by a turn of twice the angle.
template <int j>
HWY_INLINE void extendQuadTurn(int bandCount, QuadVector cosTwice, QuadVector sinTwice,
                               QuadTurn& turn) {
    if constexpr (j < kMaxQuads) {
        if (2 * j >= bandCount) return;
        const QuadVector cosine = turn.cosine[j - 1], sine = turn.sine[j - 1];
        turn.cosine[j] = hn::MulSub(cosine, cosTwice, hn::Mul(sine, sinTwice));
        turn.sine[j] = hn::MulAdd(sine, cosTwice, hn::Mul(cosine, sinTwice));
        extendQuadTurn<j + 1>(bandCount, cosTwice, sinTwice, turn);
    }
}

HWY_INLINE QuadTurn makeQuadTurn(int bandCount, QuadVector cosine, QuadVector sine) {
    const QuadVector sign = setQuad(-1.0f, -1.0f, 1.0f, 1.0f);
    const QuadVector signedSine = hn::Mul(sign, sine);
    const QuadVector sinTwice = hn::Mul(hn::Add(signedSine, signedSine), cosine);
    const QuadVector cosTwice = hn::MulSub(cosine, cosine, hn::Mul(sine, sine));
    QuadTurn turn;
    turn.cosine[0] =
        hn::MulAdd(setQuad(0.0f, 1.0f, 1.0f, 0.0f), cosine, setQuad(1.0f, 0.0f, 0.0f, 1.0f));
    turn.sine[0] = hn::Mul(setQuad(0.0f, -1.0f, 1.0f, 0.0f), sine);
    extendQuadTurn<1>(bandCount, cosTwice, sinTwice, turn);
    return turn;
}

/// E in blocks of four: what vector `column`, its lanes swapped as in exchangeQuads, gives to
/// vector `row`.
template <int l>
constexpr auto makeExchangeQuads() {
    constexpr int kCount = quadCount(l);
    std::array<float, 4 * kCount * kCount> quads{};
    for (int block = 0; block < kCount * kCount; ++block) {
        const int row = 2 * (block / kCount), column = 2 * (block % kCount);
        const int swap = l % 2;
        const int rows[4] = {row, row + 1, -row - 1, -row};
        const int columns[4] = {column + swap, column + 1 - swap, -column - swap,
                                -column - 1 + swap};
        for (int lane = 0; lane < 4; ++lane) {
            const int m = rows[lane], k = columns[lane];
            const bool isPresent =
                m <= l && -m <= l && k <= l && -k <= l && (lane < 2 || (m != 0 && k != 0));
            const auto place = static_cast<std::size_t>(4 * block + lane);
            quads[place] = isPresent ? static_cast<float>(exchangeEntry(l, m, k)) : 0.0f;
        }
    }
    return quads;
}

template <int l>
HWY_INLINE void loadQuads(const float* centre, QuadVector* band) {
    const Quad d;
    const hn::Half<Quad> half;
    for (int j = 0; 2 * j + 1 <= l; ++j)
        band[j] =
            hn::Combine(d, hn::LoadU(half, centre - 2 * j - 1), hn::LoadU(half, centre + 2 * j));
    // Lanes that no order fills hold numbers of the band, for E to multiply with zeros.
    if constexpr (l % 2 == 0) {
        band[l / 2] = hn::ConcatUpperLower(d, hn::Set(d, centre[-l]), hn::Set(d, centre[l]));
    }
}

template <int l>
HWY_INLINE void storeQuads(const QuadVector* band, float* centre) {
    const Quad d;
    const hn::Half<Quad> half;
    for (int j = 0; 2 * j + 1 <= l; ++j) {
        hn::StoreU(hn::UpperHalf(half, band[j]), half, centre - 2 * j - 1);
        hn::StoreU(hn::LowerHalf(half, band[j]), half, centre + 2 * j);
    }
    if constexpr (l % 2 == 0) {
        centre[l] = hn::GetLane(band[l / 2]);
        centre[-l] = hn::GetLane(hn::Reverse(d, band[l / 2]));
    }
}

template <int l>
HWY_INLINE void turnQuads(const QuadTurn& turn, QuadVector* band) {
    for (int j = 0; j < quadCount(l); ++j) {
        const QuadVector mirrored = hn::Mul(turn.sine[j], hn::Reverse(Quad(), band[j]));
        band[j] = hn::MulAdd(turn.cosine[j], band[j], mirrored);
    }
}

template <int l>
HWY_INLINE void exchangeQuads(QuadVector* band) {
    constexpr int kCount = quadCount(l);
    HWY_ALIGN static constexpr auto kExchange = makeExchangeQuads<l>();
    const Quad d;
    QuadVector swapped[kCount];
    for (int j = 0; j < kCount; ++j) {
        const QuadVector neighbours = hn::Shuffle2301(band[j]);
        swapped[j] = l % 2 == 0 ? hn::ConcatUpperLower(d, neighbours, band[j])
                                : hn::ConcatUpperLower(d, band[j], neighbours);
    }
    const float* entries = kExchange.data();
    for (int row = 0; row < kCount; ++row) {
        band[row] = hn::Mul(hn::Load(d, entries), swapped[0]);
        for (int column = 1; column < kCount; ++column)
            band[row] = hn::MulAdd(hn::Load(d, entries + 4 * column), swapped[column], band[row]);
        entries += 4 * kCount;
    }
}

struct QuadTurns {
    QuadTurn alpha, minusBeta, gamma;
    QuadVector sign;
};

/// Rotates the bands from degree l ≥ 1 up.
template <int l>
HWY_INLINE void rotateQuads(const QuadTurns& turns, int bandCount, const float* source,
                            float* rotated) {
    if constexpr (l < kMaxBandCount) {
        if (l >= bandCount) return;
        QuadVector band[quadCount(l)];
        loadQuads<l>(source + shIndex(l, 0), band);
        if constexpr (l % 2 == 1) {
            for (QuadVector& quad : band)
                quad = hn::Mul(turns.sign, quad);
        }
        turnQuads<l>(turns.gamma, band);
        exchangeQuads<l>(band);
        turnQuads<l>(turns.minusBeta, band);
        exchangeQuads<l>(band);
        turnQuads<l>(turns.alpha, band);
        storeQuads<l>(band, rotated + shIndex(l, 0));
        rotateQuads<l + 1>(turns, bandCount, source, rotated);
    }
}

void rotateFloats(const Mat3d& rotation, int bandCount, std::size_t channelCount,
                  const float* source, float* rotated) {
    const auto found = findTurns(Quad(), rotation);
    const auto makeTurn = [bandCount](const Turn<QuadVector>& turn) HWY_ATTR {
        return makeQuadTurn(bandCount, turn.cosine[1], turn.sine[1]);
    };
    const QuadTurns turns = {makeTurn(found.alpha), makeTurn(found.minusBeta),
                             makeTurn(found.gamma), found.sign};
    const auto channelSize = static_cast<std::size_t>(shCoefficientCount(bandCount));
    for (std::size_t i = 0; i < channelCount * channelSize; i += channelSize) {
        rotated[i] = source[i];
        rotateQuads<1>(turns, bandCount, source + i, rotated + i);
    }
}

#endif  // HWY_TARGET == HWY_SCALAR

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
    // Most often there is one, and a division takes as long as rotating a band.
    const std::size_t count = sourceSize == channelSize ? 1 : sourceSize / channelSize;
    PRT_ASSERT(count * channelSize == sourceSize && rotatedSize == sourceSize,
               "there is one coefficient a function and channel");
    return count;
}

/// Degree 1 is a vector v, f(ω) ~ v·ω: its functions are −y, z and −x (C2).
template <class Real>
void rotateDegree1(const Imath::Matrix33<Real>& r, const Real* source, Real* rotated) {
    const Real x = -source[3], y = -source[1], z = source[2];
    rotated[1] = -(r[1][0] * x + r[1][1] * y + r[1][2] * z);
    rotated[2] = r[2][0] * x + r[2][1] * y + r[2][2] * z;
    rotated[3] = -(r[0][0] * x + r[0][1] * y + r[0][2] * z);
}

/// Degree 2 is a symmetric matrix A without trace, f(ω) ~ ωᵀA ω, which becomes R A Rᵀ: its
/// functions are xy, −yz, (3z² − 1)/(2√3), −xz and (x² − y²)/2 but for a factor (C2).
template <class Real>
void rotateDegree2(const Imath::Matrix33<Real>& r, const Real* source, Real* rotated) {
    constexpr Real kRoot3 = std::numbers::sqrt3_v<Real>;
    const Real xy = source[4], yz = -source[5], xz = -source[7];
    const Real third = kRoot3 / 3 * source[6];
    const Real xx = source[8] - third, yy = -source[8] - third, zz = 2 * third;
    using Row = Imath::Vec3<Real>;
    const auto multiplyRow = [&](int i) {
        return Row(r[i][0] * xx + r[i][1] * xy + r[i][2] * xz,
                   r[i][0] * xy + r[i][1] * yy + r[i][2] * yz,
                   r[i][0] * xz + r[i][1] * yz + r[i][2] * zz);
    };
    const auto entry = [&](const Row& row, int j) {
        return row.x * r[j][0] + row.y * r[j][1] + row.z * r[j][2];
    };
    const Row x = multiplyRow(0), y = multiplyRow(1), z = multiplyRow(2);  // of R A
    rotated[4] = entry(x, 1);
    rotated[5] = -entry(y, 2);
    rotated[6] = kRoot3 / 2 * entry(z, 2);
    rotated[7] = -entry(x, 2);
    rotated[8] = Real(0.5) * (entry(x, 0) - entry(y, 1));
}

/// Up to three bands, which are rotated sooner than turns are found.
template <class Real>
void rotateFewBands(const Mat3d& rotation, int bandCount, std::span<const Real> source,
                    std::span<Real> rotated) {
    const Imath::Matrix33<Real> matrix(rotation);
    const auto channelSize = static_cast<std::size_t>(shCoefficientCount(bandCount));
    for (std::size_t i = 0; i < source.size(); i += channelSize) {
        rotated[i] = source[i];
        if (bandCount > 1) rotateDegree1(matrix, &source[i], &rotated[i]);
        if (bandCount > 2) rotateDegree2(matrix, &source[i], &rotated[i]);
    }
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
    if (bandCount <= 3) {
        rotateFewBands(rotation, bandCount, source, rotated);
    } else if (bandCount <= kMaxBandCount) {
        HWY_DYNAMIC_DISPATCH(rotateFloats)
        (rotation, bandCount, channelCount, source.data(), rotated.data());
    } else {
        rotateByMatrix(rotation, bandCount, source, rotated);
    }
}

void rotateSh(const Mat3d& rotation, int bandCount, std::span<const double> source,
              std::span<double> rotated) {
    const std::size_t channelCount = countChannels(bandCount, source.size(), rotated.size());
    if (bandCount <= 3) {
        rotateFewBands(rotation, bandCount, source, rotated);
    } else if (bandCount <= kMaxBandCount) {
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
