#include "prt/relight/matrix_kernel.h"

#include <algorithm>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "prt/relight/matrix_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "prt/relight/relight_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {
namespace {

constexpr std::size_t kLanes = kIncidentLanes;
constexpr std::size_t kLightRow = 3 * kLanes;

/// So far ahead of the product grey matrices are asked for. The hardware, which looks ahead by
/// itself, stops at each page's end; with coloured ones, whose product takes less time than reading
/// them, asking more gains nothing.
constexpr std::size_t kAheadBytes = std::size_t{8} << 10;

/// Where the results of a block go.
struct GroupResult {
    std::size_t matrixStride = 0;  ///< floats of incident radiance
    std::size_t channelStride = 0;
    float* incident = nullptr;  ///< of the first matrix, from the first of the rows on
};

/// Writes rows of 16/w matrices, w of each.
#if HWY_TARGET == HWY_SCALAR
template <std::size_t kWidth, class D>
HWY_INLINE void storeRows(D d, hn::Vec<D> rows, std::size_t, float* to) {
    hn::StoreU(rows, d, to);
}
#else
template <std::size_t kWidth, class D>
HWY_INLINE void storeRows(D d, hn::Vec<D> rows, std::size_t matrixStride, float* to) {
    if constexpr (hn::MaxLanes(D()) <= kWidth) {
        hn::StoreU(rows, d, to);
    } else {
        const hn::Half<D> half;
        storeRows<kWidth>(half, hn::LowerHalf(half, rows), matrixStride, to);
        storeRows<kWidth>(half, hn::UpperHalf(half, rows), matrixStride,
                          to + hn::Lanes(half) / kWidth * matrixStride);
    }
}
#endif

/// Writes the lanes from `lane` on of a vector of each color, the `vector`th of a group.
template <std::size_t kWidth>
HWY_INLINE void storeSums(Vector sums, std::size_t vector, std::size_t lane, std::size_t color,
                          const GroupResult& result) {
    const std::size_t matrix = vector * (kLanes / kWidth) + lane / kWidth;
    storeRows<kWidth>(FloatTag(), sums, result.matrixStride,
                      result.incident + matrix * result.matrixStride +
                          color * result.channelStride + lane % kWidth);
}

/// Zeros what a block's rows end with, from the last whole vector on.
HWY_INLINE void clearPadding(const MatrixView& matrices, const GroupResult& result) {
    const FloatTag d;
    const std::size_t begin = matrices.rowCount / kLanes * kLanes;
    for (std::size_t matrix = 0; matrix < kMatrixBlockSize; ++matrix)
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (std::size_t row = begin; row < result.channelStride; row += hn::Lanes(d))
                hn::StoreU(hn::Zero(d), d,
                           result.incident + matrix * result.matrixStride +
                               channel * result.channelStride + row);
}

/// Multiplies matrices that are the same for red, green and blue. @return  behind the last number
template <std::size_t kWidth, class Stored>
HWY_NOINLINE const Stored* multiplyGrey(const Stored* numbers, const float* light,
                                        std::size_t columnCount, const GroupResult& result) {
    const FloatTag d;
    constexpr std::size_t kTogether = vectorsTogether(kWidth);
    constexpr std::size_t kColumnBytes = kTogether * kLanes * sizeof(Stored);
    for (std::size_t first = 0; first < kWidth; first += kTogether) {
        for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(d)) {
            const Stored* column = numbers + lane;
            const float* lightRow = light + lane;
            Vector sums[3][kTogether];
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t v = 0; v < kTogether; ++v)
                    sums[c][v] = hn::Load(d, lightRow + c * kLanes);
            for (std::size_t j = 0; j < columnCount; ++j) {
                askFor(reinterpret_cast<const std::byte*>(column) + kAheadBytes, kColumnBytes);
                lightRow += kLightRow;
                const Vector red = hn::Load(d, lightRow);
                const Vector green = hn::Load(d, lightRow + kLanes);
                const Vector blue = hn::Load(d, lightRow + 2 * kLanes);
                for (std::size_t v = 0; v < kTogether; ++v) {
                    const Vector number = loadLanes(column + v * kLanes);
                    sums[0][v] = hn::MulAdd(number, red, sums[0][v]);
                    sums[1][v] = hn::MulAdd(number, green, sums[1][v]);
                    sums[2][v] = hn::MulAdd(number, blue, sums[2][v]);
                }
                column += kTogether * kLanes;
            }
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t v = 0; v < kTogether; ++v)
                    storeSums<kWidth>(sums[c][v], first + v, lane, c, result);
        }
        numbers += columnCount * kTogether * kLanes;
    }
    return numbers;
}

/// The same of coloured ones.
template <std::size_t kWidth, class Stored>
HWY_NOINLINE const Stored* multiplyColored(const Stored* numbers, const float* light,
                                           std::size_t columnCount, const GroupResult& result) {
    const FloatTag d;
    constexpr std::size_t kTogether = vectorsTogether(kWidth);
    for (std::size_t first = 0; first < kWidth; first += kTogether) {
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(d)) {
                const Stored* column = numbers + lane;
                const float* lightRow = light + c * kLanes + lane;
                Vector sums[kTogether];
                for (std::size_t v = 0; v < kTogether; ++v)
                    sums[v] = hn::Load(d, lightRow);
                for (std::size_t j = 0; j < columnCount; ++j) {
                    lightRow += kLightRow;
                    const Vector factor = hn::Load(d, lightRow);
                    for (std::size_t v = 0; v < kTogether; ++v)
                        sums[v] = hn::MulAdd(loadLanes(column + v * kLanes), factor, sums[v]);
                    column += kTogether * kLanes;
                }
                for (std::size_t v = 0; v < kTogether; ++v)
                    storeSums<kWidth>(sums[v], first + v, lane, c, result);
            }
            numbers += columnCount * kTogether * kLanes;
        }
    }
    return numbers;
}

template <std::size_t kWidth, class Stored>
const Stored* multiplyGroup(const Stored* numbers, const float* light, const MatrixView& matrices,
                            const GroupResult& result) {
    return matrices.channelCount == 1
               ? multiplyGrey<kWidth>(numbers, light, matrices.columnCount, result)
               : multiplyColored<kWidth>(numbers, light, matrices.columnCount, result);
}

template <class Stored>
void multiplyStored(const MatrixView& matrices, const float* light, std::size_t blockCount,
                    GroupResult result) {
    const auto* numbers = reinterpret_cast<const Stored*>(matrices.data);
    for (std::size_t block = 0; block < blockCount; ++block) {
        clearPadding(matrices, result);
        const float* groupLight = light;
        for (const RowGroup& group : matrices.groups) {
            GroupResult rows = result;
            rows.incident += group.firstRow;
            switch (group.width) {
                case 16:
                    numbers = multiplyGroup<16>(numbers, groupLight, matrices, rows);
                    break;
                case 8:
                    numbers = multiplyGroup<8>(numbers, groupLight, matrices, rows);
                    break;
                case 4:
                    numbers = multiplyGroup<4>(numbers, groupLight, matrices, rows);
                    break;
                default:
                    numbers = multiplyGroup<1>(numbers, groupLight, matrices, rows);
            }
            groupLight += (1 + matrices.columnCount) * kLightRow;
        }
        result.incident += kMatrixBlockSize * result.matrixStride;
    }
}

void multiply(const MatrixView& matrices, const float* light, std::size_t blockCount,
              std::size_t stride, float* incident) {
    const GroupResult result = {stride, matrices.paddedRowCount, incident};
    switch (matrices.encoding) {
        case TransferEncoding::float32:
            return multiplyStored<float>(matrices, light, blockCount, result);
        case TransferEncoding::unorm16:
            return multiplyStored<std::uint16_t>(matrices, light, blockCount, result);
        case TransferEncoding::unorm8:
            return multiplyStored<std::uint8_t>(matrices, light, blockCount, result);
    }
}

}  // namespace
}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace prt {

HWY_EXPORT(multiply);

std::vector<RowGroup> cutRows(std::size_t rowCount) {
    std::vector<RowGroup> groups;
    std::size_t row = 0;
    for (const std::size_t width : {16, 8, 4, 1})
        for (; row + width <= rowCount; row += width)
            groups.push_back({row, width});
    return groups;
}

void multiplyMatrices(const MatrixView& matrices, const float* light, std::size_t blockCount,
                      std::size_t stride, float* incident) {
    HWY_DYNAMIC_DISPATCH(multiply)(matrices, light, blockCount, stride, incident);
}

}  // namespace prt
#endif  // HWY_ONCE
