#include "prt/compress/row_kernel.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "prt/compress/row_kernel.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using DoubleTag = hn::CappedTag<double, 8>;
using Vector = hn::Vec<DoubleTag>;

constexpr std::size_t kColumnCount = 8;
constexpr std::size_t kVectorCount = kColumnCount / hn::MaxLanes(DoubleTag());
// As many rows as leave the sums in registers.
constexpr std::size_t kRowCount = kVectorCount == 1 ? 8 : kVectorCount == 2 ? 4 : 2;

/// The first numbers of a vector, and zeros: nothing behind them is read.
template <class Tag, class Number>
HWY_INLINE hn::Vec<Tag> loadFirst(Tag tag, const Number* numbers, std::size_t count) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
    return hn::MaskedLoad(hn::FirstN(tag, count), tag, numbers);
#else
    HWY_ALIGN Number first[hn::MaxLanes(tag)] = {};
    std::copy_n(numbers, count, first);
    return hn::Load(tag, first);
#endif
}

/// @param row  [paddedSize(dimension)], written
HWY_INLINE void gatherRow(const WeightedVectors& vectors, std::uint32_t member, const double* shift,
                          double* row) {
    const DoubleTag d;
    const hn::Rebind<float, DoubleTag> df;
    const float* numbers = vectors.numbers.data() + member * vectors.dimension;
    const float* origin = vectors.origin.data();
    const float* scale = vectors.scale.data();
    std::size_t left = vectors.dimension;
    for (; left >= hn::Lanes(d); left -= hn::Lanes(d)) {
        const Vector x = hn::PromoteTo(d, hn::LoadU(df, numbers));
        const Vector c = hn::PromoteTo(d, hn::LoadU(df, origin));
        const Vector s = hn::PromoteTo(d, hn::LoadU(df, scale));
        hn::StoreU(hn::MulSub(hn::Sub(x, c), s, hn::LoadU(d, shift)), d, row);
        numbers += hn::Lanes(d);
        origin += hn::Lanes(d);
        scale += hn::Lanes(d);
        shift += hn::Lanes(d);
        row += hn::Lanes(d);
    }
    // Whole vectors to the end: what is read next is loaded as it was stored.
    const double* end = row + paddedSize(vectors.dimension) - (vectors.dimension - left);
    if (left > 0) {
        const Vector x = hn::PromoteTo(d, loadFirst(df, numbers, left));
        const Vector c = hn::PromoteTo(d, loadFirst(df, origin, left));
        const Vector s = hn::PromoteTo(d, loadFirst(df, scale, left));
        hn::StoreU(hn::MulSub(hn::Sub(x, c), s, loadFirst(d, shift, left)), d, row);
        row += hn::Lanes(d);
    }
    for (; row != end; row += hn::Lanes(d))
        hn::StoreU(hn::Zero(d), d, row);
}

/// Asks for a row that is needed soon: members lie far apart.
HWY_INLINE void prefetchRow(const WeightedVectors& vectors, std::span<const std::uint32_t> members,
                            std::size_t i) {
    constexpr std::size_t kLineFloats = 16, kMostFloats = 128;  // the machine sees to the rest
    if (i >= members.size()) return;
    const float* row = vectors.numbers.data() + members[i] * vectors.dimension;
    for (std::size_t j = 0; j < std::min(kMostFloats, vectors.dimension); j += kLineFloats)
        hwy::Prefetch(row + j);
    hwy::Prefetch(row + vectors.dimension - 1);
}

constexpr std::size_t kRowsAhead = 24;

void gatherRows(const WeightedVectors& vectors, std::span<const std::uint32_t> members,
                const double* shift, double* rows) {
    for (std::size_t i = 0; i < members.size(); ++i, rows += paddedSize(vectors.dimension)) {
        prefetchRow(vectors, members, i + kRowsAhead);
        gatherRow(vectors, members[i], shift, rows);
    }
}

/// One block of 8 columns by a few rows of the matrix.
HWY_INLINE void addBlock(const double* rows, std::size_t rowCount, std::size_t size, std::size_t i,
                         std::size_t column, double* matrix) {
    const DoubleTag d;
    const std::size_t lanes = hn::Lanes(d);
    Vector sums[kRowCount][kVectorCount];
    for (std::size_t r = 0; r < kRowCount; ++r) {
        for (std::size_t v = 0; v < kVectorCount; ++v)
            sums[r][v] = hn::LoadU(d, matrix + (i + r) * size + column + v * lanes);
    }
    for (std::size_t k = 0; k < rowCount; ++k, rows += size) {
        Vector right[kVectorCount];
        for (std::size_t v = 0; v < kVectorCount; ++v)
            right[v] = hn::LoadU(d, rows + column + v * lanes);
        for (std::size_t r = 0; r < kRowCount; ++r) {
            const Vector left = hn::Set(d, rows[i + r]);
            for (std::size_t v = 0; v < kVectorCount; ++v)
                sums[r][v] = hn::MulAdd(left, right[v], sums[r][v]);
        }
    }
    for (std::size_t r = 0; r < kRowCount; ++r) {
        for (std::size_t v = 0; v < kVectorCount; ++v)
            hn::StoreU(sums[r][v], d, matrix + (i + r) * size + column + v * lanes);
    }
}

void addProducts(const double* rows, std::size_t rowCount, std::size_t size, double* matrix) {
    for (std::size_t i = 0; i < size; i += kRowCount) {
        for (std::size_t column = i / kColumnCount * kColumnCount; column < size;
             column += kColumnCount)
            addBlock(rows, rowCount, size, i, column, matrix);
    }
}

HWY_INLINE double dotRows(const double* a, const double* b, std::size_t size) {
    const DoubleTag d;
    Vector sum = hn::Zero(d);
    for (std::size_t j = 0; j < size; j += hn::Lanes(d))
        sum = hn::MulAdd(hn::LoadU(d, a + j), hn::LoadU(d, b + j), sum);
    return hn::GetLane(hn::SumOfLanes(d, sum));
}

void addRows(std::span<const double> rows, std::span<double> sum) {
    const DoubleTag d;
    for (std::size_t j = 0; j < sum.size(); j += hn::Lanes(d)) {
        Vector total = hn::LoadU(d, sum.data() + j);
        for (std::size_t i = j; i < rows.size(); i += sum.size())
            total = hn::Add(total, hn::LoadU(d, rows.data() + i));
        hn::StoreU(total, d, sum.data() + j);
    }
}

void lowerDistances(const double* rows, std::span<const double> point,
                    std::span<double> distances) {
    const DoubleTag d;
    for (double& distance : distances) {
        Vector sum = hn::Zero(d);
        for (std::size_t j = 0; j < point.size(); j += hn::Lanes(d)) {
            const Vector offset = hn::Sub(hn::LoadU(d, rows + j), hn::LoadU(d, point.data() + j));
            sum = hn::MulAdd(offset, offset, sum);
        }
        distance = std::min(distance, hn::GetLane(hn::SumOfLanes(d, sum)));
        rows += point.size();
    }
}

double projectRow(const double* row, std::size_t size, const double* axes,
                  std::span<float> weights) {
    const DoubleTag d;
    for (std::size_t p = 0; p < weights.size(); ++p)
        weights[p] = static_cast<float>(dotRows(row, axes + p * size, size));
    Vector squares = hn::Zero(d);
    for (std::size_t j = 0; j < size; j += hn::Lanes(d)) {
        Vector left = hn::LoadU(d, row + j);
        for (std::size_t p = 0; p < weights.size(); ++p)
            left = hn::NegMulAdd(hn::Set(d, double{weights[p]}), hn::LoadU(d, axes + p * size + j),
                                 left);
        squares = hn::MulAdd(left, left, squares);
    }
    return hn::GetLane(hn::SumOfLanes(d, squares));
}

double sumByLabel(const WeightedVectors& vectors, std::span<const std::uint32_t> members,
                  std::span<const std::uint32_t> labels, const double* points, double* row,
                  double* sums) {
    const DoubleTag d;
    const std::size_t size = paddedSize(vectors.dimension);
    Vector squares = hn::Zero(d);
    for (std::size_t i = 0; i < members.size(); ++i) {
        double* sum = sums + labels[i] * size;
        gatherRow(vectors, members[i], points + labels[i] * size, row);
        for (std::size_t j = 0; j < size; j += hn::Lanes(d)) {
            const Vector y = hn::LoadU(d, row + j);
            squares = hn::MulAdd(y, y, squares);
            hn::StoreU(hn::Add(hn::LoadU(d, sum + j), y), d, sum + j);
        }
    }
    return hn::GetLane(hn::SumOfLanes(d, squares));
}

}  // namespace
}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace prt {

HWY_EXPORT(gatherRows);
HWY_EXPORT(sumByLabel);
HWY_EXPORT(addRows);
HWY_EXPORT(lowerDistances);
HWY_EXPORT(addProducts);
HWY_EXPORT(projectRow);

void gatherRows(const WeightedVectors& vectors, std::span<const std::uint32_t> members,
                std::span<const double> shift, std::span<double> rows) {
    HWY_DYNAMIC_DISPATCH(gatherRows)(vectors, members, shift.data(), rows.data());
}

double sumByLabel(const WeightedVectors& vectors, std::span<const std::uint32_t> members,
                  std::span<const std::uint32_t> labels, std::span<const double> points,
                  std::span<double> sums) {
    std::vector<double> row(paddedSize(vectors.dimension));
    return HWY_DYNAMIC_DISPATCH(sumByLabel)(vectors, members, labels, points.data(), row.data(),
                                            sums.data());
}

void addRows(std::span<const double> rows, std::span<double> sum) {
    HWY_DYNAMIC_DISPATCH(addRows)(rows, sum);
}

void lowerDistances(std::span<const double> rows, std::span<const double> point,
                    std::span<double> distances) {
    HWY_DYNAMIC_DISPATCH(lowerDistances)(rows.data(), point, distances);
}

void addProducts(std::span<const double> rows, std::size_t size, std::span<double> matrix) {
    HWY_DYNAMIC_DISPATCH(addProducts)(rows.data(), rows.size() / size, size, matrix.data());
}

double projectRow(std::span<const double> row, std::span<const double> axes,
                  std::span<float> weights) {
    return HWY_DYNAMIC_DISPATCH(projectRow)(row.data(), row.size(), axes.data(), weights);
}

}  // namespace prt
#endif  // HWY_ONCE
