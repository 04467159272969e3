#include "prt/compress/subspace_kernel.h"

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <limits>
#include <new>
#include <numbers>

#include "prt/base/assert.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "prt/compress/subspace_kernel.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef PRT_COMPRESS_TILE
#define PRT_COMPRESS_TILE
namespace prt {
namespace {

/// 64 vectors, transposed, and what is found of them.
struct Tile {
    static constexpr std::size_t kSize = 64;

    hwy::AlignedFreeUniquePtr<float[]> numbers;  ///< [dimension][64]
    alignas(64) float squaredLengths[kSize] = {};
    alignas(64) float advantages[kSize] = {};
    alignas(64) float bestScores[kSize] = {};
    alignas(64) std::int32_t bestPositions[kSize] = {};
    bool prefersFirst = false;
    float* allScores = nullptr;  ///< [subspace][64], or none
};

}  // namespace
}  // namespace prt
#endif

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
using IntTag = hn::RebindToSigned<FloatTag>;
using Vector = hn::Vec<FloatTag>;
using IntVector = hn::Vec<IntTag>;

// As many vectors times rows as leave the sums in registers.
#if HWY_TARGET <= HWY_AVX3
constexpr std::size_t kVectorCount = 4;
#else
constexpr std::size_t kVectorCount = 2;
#endif
constexpr std::size_t kRowCount = SubspaceRows::kGroupSize;

/// Asks for a row that is needed soon: members may lie far apart.
HWY_INLINE void prefetchRow(const float* row, std::size_t dimension) {
    constexpr std::size_t kLineFloats = 16, kMostFloats = 128;  // the machine sees to the rest
    for (std::size_t j = 0; j < std::min(kMostFloats, dimension); j += kLineFloats)
        hwy::Prefetch(row + j);
}

/// Fills a tile with the first members; its unused lanes with zeros.
void loadTile(const WeightedVectors& vectors, std::span<const std::uint32_t> members, Tile& tile) {
    const std::size_t count = std::min(Tile::kSize, members.size());
    const std::size_t dimension = vectors.dimension;
    const float* origin = vectors.origin.data();
    const float* scale = vectors.scale.data();
    if (count < Tile::kSize) std::fill_n(tile.numbers.get(), dimension * Tile::kSize, 0.0f);
    for (std::size_t lane = 0; lane < count; ++lane) {
        const float* row = vectors.numbers.data() + members[lane] * dimension;
        float* column = tile.numbers.get() + lane;
        if (lane + Tile::kSize < members.size())
            prefetchRow(vectors.numbers.data() + members[lane + Tile::kSize] * dimension,
                        dimension);
        for (std::size_t j = 0; j < dimension; ++j)
            column[j * Tile::kSize] = (row[j] - origin[j]) * scale[j];
    }
    const FloatTag d;
    const Vector advantage = hn::Set(d, tile.prefersFirst ? 0x1p-21f : 0.0f);
    for (std::size_t lane = 0; lane < Tile::kSize; lane += hn::Lanes(d)) {
        Vector sum = hn::Zero(d);
        for (std::size_t j = 0; j < dimension; ++j) {
            const Vector y = hn::Load(d, tile.numbers.get() + j * Tile::kSize + lane);
            sum = hn::MulAdd(y, y, sum);
        }
        hn::Store(sum, d, tile.squaredLengths + lane);
        hn::Store(hn::Mul(sum, advantage), d, tile.advantages + lane);
    }
}

/// The best subspaces so far of some lanes of a tile.
struct Best {
    Vector scores[kVectorCount];
    IntVector positions[kVectorCount];
};

/// Multiplies six rows by some lanes.
HWY_INLINE void multiplyRows(const float* rows, const float* constants, const float* lanes,
                             std::size_t dimension, Vector (&products)[kRowCount][kVectorCount]) {
    const FloatTag d;
    Vector sums[kRowCount][kVectorCount];
    for (std::size_t r = 0; r < kRowCount; ++r) {
        for (std::size_t v = 0; v < kVectorCount; ++v)
            sums[r][v] = hn::Set(d, constants[r]);
    }
    for (std::size_t j = 0; j < dimension; ++j, rows += kRowCount, lanes += Tile::kSize) {
        Vector y[kVectorCount];
        for (std::size_t v = 0; v < kVectorCount; ++v)
            y[v] = hn::Load(d, lanes + v * hn::Lanes(d));
        for (std::size_t r = 0; r < kRowCount; ++r) {
            const Vector number = hn::Set(d, rows[r]);
            for (std::size_t v = 0; v < kVectorCount; ++v)
                sums[r][v] = hn::MulAdd(number, y[v], sums[r][v]);
        }
    }
    for (std::size_t r = 0; r < kRowCount; ++r) {
        for (std::size_t v = 0; v < kVectorCount; ++v)
            products[r][v] = sums[r][v];
    }
}

/// Keeps a subspace where it is better than those before.
HWY_INLINE void keepBetter(const Vector (&scores)[kVectorCount], std::int32_t position,
                           Best& best) {
    const IntVector positions = hn::Set(IntTag(), position);
    for (std::size_t v = 0; v < kVectorCount; ++v) {
        const auto isBetter = hn::RebindMask(IntTag(), hn::Gt(scores[v], best.scores[v]));
        best.scores[v] = hn::Max(scores[v], best.scores[v]);
        best.positions[v] = hn::IfThenElse(isBetter, positions, best.positions[v]);
    }
}

/// The same for six points; written out, so that the products stay in registers.
HWY_INLINE void keepBest(const Vector (&products)[kRowCount][kVectorCount], std::int32_t first,
                         Best& best) {
    static_assert(kRowCount == 6);
    keepBetter(products[0], first, best);
    keepBetter(products[1], first + 1, best);
    keepBetter(products[2], first + 2, best);
    keepBetter(products[3], first + 3, best);
    keepBetter(products[4], first + 4, best);
    keepBetter(products[5], first + 5, best);
}

/// Adds up the rows of subspaces with axes, six after another.
struct SubspaceSum {
    Vector scores[kVectorCount];
    std::int32_t position = 0;

    HWY_INLINE void addRow(const Vector (&products)[kVectorCount], bool isFirst) {
        for (std::size_t v = 0; v < kVectorCount; ++v)
            scores[v] = isFirst ? products[v] : hn::MulAdd(products[v], products[v], scores[v]);
    }

    HWY_INLINE void end(std::size_t firstLane, Tile& tile, Best& best) {
        const FloatTag d;
        if (position == 0) {
            const float* advantages = tile.advantages + firstLane;
            for (std::size_t v = 0; v < kVectorCount; ++v)
                scores[v] = hn::Add(scores[v], hn::Load(d, advantages + v * hn::Lanes(d)));
        }
        keepBetter(scores, position, best);
        if (tile.allScores != nullptr) {
            float* to =
                tile.allScores + static_cast<std::size_t>(position) * Tile::kSize + firstLane;
            for (std::size_t v = 0; v < kVectorCount; ++v)
                hn::StoreU(scores[v], d, to + v * hn::Lanes(d));
        }
        ++position;
    }
};

/// Scores all subspaces for the lanes from firstLane on.
template <bool kArePoints>
HWY_INLINE void scoreLanes(const SubspaceRows& rows, std::size_t firstLane, Tile& tile) {
    const FloatTag d;
    Best best;
    SubspaceSum sum;
    for (std::size_t v = 0; v < kVectorCount; ++v) {
        best.scores[v] = hn::Set(d, -std::numeric_limits<float>::infinity());
        best.positions[v] = hn::Zero(IntTag());
        sum.scores[v] = hn::Zero(d);
    }
    const float* numbers = rows.numbers.data();
    for (std::size_t first = 0; first < rows.rowCount; first += kRowCount) {
        Vector products[kRowCount][kVectorCount];
        multiplyRows(numbers, rows.constants.data() + first, tile.numbers.get() + firstLane,
                     rows.dimension, products);
        numbers += kRowCount * rows.dimension;
        if constexpr (kArePoints) {
            keepBest(products, static_cast<std::int32_t>(first), best);
            continue;
        }
        for (std::size_t r = 0; r < kRowCount && first + r < rows.rowCount; ++r) {
            sum.addRow(products[r], rows.isFirst[first + r] != 0);
            if (rows.isLast[first + r] != 0) sum.end(firstLane, tile, best);
        }
    }
    for (std::size_t v = 0; v < kVectorCount; ++v) {
        hn::Store(best.scores[v], d, tile.bestScores + firstLane + v * hn::Lanes(d));
        hn::Store(best.positions[v], IntTag(), tile.bestPositions + firstLane + v * hn::Lanes(d));
    }
}

void scoreTile(const SubspaceRows& rows, Tile& tile) {
    constexpr std::size_t kStep = kVectorCount * hn::MaxLanes(FloatTag());
    static_assert(Tile::kSize % kStep == 0);
    const bool arePoints =
        rows.rowCount == rows.subspaceCount && tile.allScores == nullptr && !tile.prefersFirst;
    for (std::size_t lane = 0; lane < Tile::kSize; lane += kStep) {
        if (arePoints)
            scoreLanes<true>(rows, lane, tile);
        else
            scoreLanes<false>(rows, lane, tile);
    }
}

}  // namespace
}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace prt {

HWY_EXPORT(loadTile);
HWY_EXPORT(scoreTile);

namespace {

Tile makeTile(std::size_t dimension) {
    Tile tile;
    tile.numbers = hwy::AllocateAligned<float>(dimension * Tile::kSize);
    if (!tile.numbers) throw std::bad_alloc();
    return tile;
}

double dot(std::span<const double> a, std::span<const double> b) {
    double sum = 0.0;
    for (std::size_t j = 0; j < a.size(); ++j)
        sum += a[j] * b[j];
    return sum;
}

}  // namespace

SubspaceRows::SubspaceRows(std::span<const Subspace> subspaces,
                           std::span<const std::uint32_t> chosen)
    : dimension(subspaces.front().mean.size()), subspaceCount(chosen.size()) {
    // The ½ of the squares goes into the rows.
    constexpr double kFactor = std::numbers::sqrt2 / 2.0;
    std::size_t total = 0;
    for (const std::uint32_t index : chosen)
        total += 1 + subspaces[index].axisCount();
    const std::size_t groupCount = (total + kGroupSize - 1) / kGroupSize;
    numbers.assign(groupCount * kGroupSize * dimension, 0.0f);
    constants.assign(groupCount * kGroupSize, std::numeric_limits<float>::lowest());
    for (const std::uint32_t index : chosen) {
        const Subspace& subspace = subspaces[index];
        addRow(subspace.mean, 1.0, -0.5 * dot(subspace.mean, subspace.mean));
        isFirst.back() = 1;
        for (std::size_t p = 0; p < subspace.axisCount(); ++p) {
            const auto axis = std::span(subspace.axes).subspan(p * dimension, dimension);
            addRow(axis, kFactor, -kFactor * dot(axis, subspace.mean));
        }
        isLast.back() = 1;
    }
}

void SubspaceRows::addRow(std::span<const double> row, double factor, double constant) {
    float* to = numbers.data() + rowCount / kGroupSize * kGroupSize * dimension;
    for (std::size_t j = 0; j < dimension; ++j)
        to[j * kGroupSize + rowCount % kGroupSize] = static_cast<float>(factor * row[j]);
    constants[rowCount] = static_cast<float>(constant);
    isFirst.push_back(0);
    isLast.push_back(0);
    ++rowCount;
}

void findNearestSubspaces(const WeightedVectors& vectors, std::span<const std::uint32_t> members,
                          const SubspaceRows& rows, bool prefersFirst,
                          const NearestSubspaces& nearest) {
    Tile tile = makeTile(vectors.dimension);
    tile.prefersFirst = prefersFirst;
    for (std::size_t begin = 0; begin < members.size(); begin += Tile::kSize) {
        const std::size_t count = std::min(Tile::kSize, members.size() - begin);
        HWY_DYNAMIC_DISPATCH(loadTile)(vectors, members.subspan(begin), tile);
        HWY_DYNAMIC_DISPATCH(scoreTile)(rows, tile);
        for (std::size_t lane = 0; lane < count; ++lane) {
            nearest.positions[begin + lane] = static_cast<std::uint32_t>(tile.bestPositions[lane]);
            nearest.squaredDistances[begin + lane] =
                std::max(0.0f, tile.squaredLengths[lane] - 2.0f * tile.bestScores[lane]);
        }
    }
}

void measureSubspaceDistances(const WeightedVectors& vectors,
                              std::span<const std::uint32_t> members, const SubspaceRows& rows,
                              std::span<float> squaredDistances) {
    PRT_ASSERT(members.size() <= Tile::kSize, "the vectors fit into one tile");
    Tile tile = makeTile(vectors.dimension);
    tile.allScores = squaredDistances.data();
    HWY_DYNAMIC_DISPATCH(loadTile)(vectors, members, tile);
    HWY_DYNAMIC_DISPATCH(scoreTile)(rows, tile);
    for (std::size_t i = 0; i < squaredDistances.size(); ++i)
        squaredDistances[i] =
            std::max(0.0f, tile.squaredLengths[i % Tile::kSize] - 2.0f * squaredDistances[i]);
}

}  // namespace prt
#endif  // HWY_ONCE
