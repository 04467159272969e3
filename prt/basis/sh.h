#pragma once

#include <cstddef>
#include <span>

#include "prt/math/vector.h"

namespace prt {

/// Real orthonormal spherical harmonics with the Condon-Shortley phase, polar axis +z (C1, C2):
///
///   y_lm(θ, φ) = (−1)^m √2 K_lm P_l^|m|(cos θ) · {cos mφ, m > 0;  sin |m|φ, m < 0}
///   y_l0(θ, φ) = K_l0 P_l(cos θ)
///
/// with K_lm = √((2l+1)/4π · (l−|m|)!/(l+|m|)!) and P without phase [Sloan08,
/// Dachsbacher17]. Coefficient (l, m) has index l(l+1)+m (C3), and "n bands" means
/// degrees 0 … n−1, n² coefficients.

/// The largest band count of the straight-line kernels, of transfer and of assets.
inline constexpr int kMaxBandCount = 10;

constexpr int shCoefficientCount(int bandCount) {
    return bandCount * bandCount;
}
constexpr int shIndex(int l, int m) {
    return l * (l + 1) + m;
}

/// Degree l of the coefficient with this index.
constexpr int shDegree(int index) {
    int l = 0;
    while ((l + 1) * (l + 1) <= index)
        ++l;
    return l;
}

/// Evaluates all basis functions in one direction.
///
/// @param direction  unit
/// @param bandCount  n ≥ 1; any, without overflow, by normalised recurrences
/// @param values     n² numbers, written
void evaluateSh(const Vec3d& direction, int bandCount, std::span<double> values);
void evaluateSh(const Vec3f& direction, int bandCount, std::span<float> values);

/// The directions evaluated at once by evaluateShBatch.
inline constexpr std::size_t kShBatchSize = 16;

/// Evaluates all basis functions in 16 directions at once, with the widest vectors of the machine.
///
/// @param x, y, z    16 numbers each: unit directions
/// @param bandCount  n in [1, kMaxBandCount]
/// @param values     16·n² numbers, written; function i in direction j stands at 16·i + j
void evaluateShBatch(std::span<const float, kShBatchSize> x, std::span<const float, kShBatchSize> y,
                     std::span<const float, kShBatchSize> z, int bandCount,
                     std::span<float> values);

/// What each band of a function adds in one direction, Σ_m c_lm y_lm.
///
/// @param coefficients  n² numbers
/// @param basis         n² basis functions, there
/// @param bands         n numbers, written
void sumShBands(std::span<const double> coefficients, std::span<const double> basis,
                std::span<double> bands);

/// The value of Σ_i c_i y_i in a direction.
double reconstructSh(std::span<const double> coefficients, int bandCount, const Vec3d& direction);

}  // namespace prt
