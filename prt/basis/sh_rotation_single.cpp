// Bibliography
//   [Dachsbacher17]  Precomputed radiance transfer
//   [Pinchon07]      Rotation matrices for real spherical harmonics
#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "prt/base/assert.h"
#include "prt/basis/sh_rotation.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "prt/basis/sh_rotation_single.cpp"
#include <hwy/foreach_target.h>

#include "prt/basis/sh_rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {
namespace {

/// findTurns of one matrix, the same in every lane.
template <class D>
HWY_INLINE Turns<hn::Vec<D>> broadcastTurns(D d, const Mat3d& rotation) {
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
    Turns<hn::Vec<decltype(d)>> turns = broadcastTurns(d, rotation);
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
    const auto found = broadcastTurns(Quad(), rotation);
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
    const Row x = multiplyRow(0), y = multiplyRow(1);  // of R A
    const Real turnedXx = entry(x, 0), turnedYy = entry(y, 1);
    rotated[4] = entry(x, 1);
    rotated[5] = -entry(y, 2);
    rotated[6] = -kRoot3 / 2 * (turnedXx + turnedYy);
    rotated[7] = -entry(x, 2);
    rotated[8] = Real(0.5) * (turnedXx - turnedYy);
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

}  // namespace prt
#endif  // HWY_ONCE
