#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "prt/math/vector.h"

namespace prt {

/// As many doubles as the widest vectors hold.
struct alignas(64) DoubleBlock {
    static constexpr std::size_t kSize = 8;
    double lanes[kSize] = {};
};

/// cos mφ and sin mφ for m = 0 … n − 1, integrated over texels of a lat-long row.
///
/// Four texels share their values but for the sign, at φ, −φ, π − φ and φ − π, so that the first
/// quarter of a row is enough. A row of odd width has no texels at π − φ, and keeps its first half.
struct AzimuthFunctions {
    int orderCount = 0;                ///< n
    std::size_t foldedSize = 0;        ///< texels of the first quarter or half, rounded up
    std::size_t blockCount = 0;        ///< of an order: these texels, and zeros that fill it up
    std::vector<DoubleBlock> cosines;  ///< n · blockCount; halved where a texel is its own mirror
    std::vector<DoubleBlock> sines;    ///< likewise
};

/// Texels of a row that have functions of their own.
constexpr std::size_t foldedRowSize(std::size_t width) {
    return width % 2 == 0 ? (width / 2 + 1) / 2 : (width + 1) / 2;
}

/// The integrals of a row times cos mφ and sin mφ.
struct AzimuthSum {
    Vec3d cosine, sine;
};

/// Integrates a row times the functions, with the widest vectors of the machine.
///
/// @param scratch  12 · blockCount blocks, zeros at first: the folded row
/// @param sums     n, written
void integrateRow(std::span<const Vec3f> row, const AzimuthFunctions& functions,
                  std::span<DoubleBlock> scratch, std::span<AzimuthSum> sums);

}  // namespace prt
