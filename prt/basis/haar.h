#pragma once

#include <bit>
#include <cstddef>
#include <span>

#include "prt/math/vector.h"

namespace prt {

/// Haar wavelets on a square of S × S texels, S a power of two, in the non-standard decomposition
/// [Stollnitz95, Ng03]: one scaling function and, for each of the 4^l squares into which level l
/// cuts the whole, three wavelets that are constant on the square's quadrants,
///
///   scaling  horizontal  vertical  diagonal
///     + +       + −         + +      + −
///     + +       + −         − −      − +      (rows go down, as in images)
///
/// of absolute value 2^l/S inside their square and 0 outside; levels are 0 (the whole square) to
/// log₂S − 1. They are orthonormal with respect to the sum over texels, Σ_t ψ_i(t) ψ_j(t) = δ_ij,
/// so Σ_i c_i² = Σ_t f(t)². On a unit square they would be S times as large, 1 and ±2^l, and
/// orthonormal with respect to ∫dxdy.
///
/// The scaling function has index 0; a wavelet has
///
///   index = 4^l · type + 2^l · y + x,  type = 1, 2, 3 (horizontal, vertical, diagonal)
///
/// with (x, y) the column and row of its square on level l. So coarse comes before fine, the
/// functions above level l are the first 4^l, each level has three planes, and no index depends
/// on S.
enum class HaarType { scaling, horizontal, vertical, diagonal };

struct HaarFunction {
    HaarType type = HaarType::scaling;
    int level = 0;  ///< 0 for the scaling function
    int x = 0;      ///< column of the square, 0 … 2^level − 1
    int y = 0;      ///< row, from the top
};

constexpr int haarIndex(const HaarFunction& function) {
    return (static_cast<int>(function.type) << (2 * function.level)) +
           (function.y << function.level) + function.x;
}

/// The level of the function with this index; 0 for the scaling function.
constexpr int haarLevel(int index) {
    return index == 0 ? 0 : (std::bit_width(static_cast<unsigned>(index)) - 1) / 2;
}

constexpr HaarFunction haarFunction(int index) {
    const int level = haarLevel(index);
    const int side = 1 << level;
    return {static_cast<HaarType>(index >> (2 * level)), level, index & (side - 1),
            (index >> level) & (side - 1)};
}

/// Whether a square of so many texels, or coefficients, has a power of two on its side.
constexpr bool isHaarCount(std::size_t count) {
    return std::has_single_bit(count) && std::countr_zero(count) % 2 == 0;
}

/// Projects a function onto the wavelets: c_i = Σ_t f(t) ψ_i(t), in time linear in the texels.
///
/// @param texels        S² values of f, row-major, row 0 at the top; S a power of two, 1 included
/// @param coefficients  S² numbers, written; must not overlap the texels
void projectHaar(std::span<const float> texels, std::span<float> coefficients);
void projectHaar(std::span<const Vec3f> texels, std::span<Vec3f> coefficients);

/// The way back: f(t) = Σ_i c_i ψ_i(t).
///
/// @param coefficients  S²
/// @param texels        S² values, written; must not overlap the coefficients
void reconstructHaar(std::span<const float> coefficients, std::span<float> texels);
void reconstructHaar(std::span<const Vec3f> coefficients, std::span<Vec3f> texels);

}  // namespace prt
