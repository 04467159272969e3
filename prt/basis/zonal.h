#pragma once

#include <span>
#include <vector>

#include "prt/math/vector.h"

namespace prt {

/// Zonal coefficients of the clamped cosine, c_l = ∫ max(cos θ, 0) y_l0 dω, in closed form
/// [Ramamoorthi01, eq. 7 and 8]: A_l √((2l+1)/4π) with A = π, 2π/3, π/4, 0, −π/24, …
std::vector<double> clampedCosineZonal(int bandCount);

/// Zonal coefficients of unit radiance from a disc of the given half angle about +z, in closed form
/// [Sloan08, appendix A3].
///
/// @param halfAngleRadians  in [0, π]
std::vector<double> capZonal(int bandCount, double halfAngleRadians);

/// Turns a zonal function about +z to another axis: c_lm = √(4π/(2l+1)) z_l y_lm(axis) [Sloan08].
///
/// @param zonal         n coefficients, one a band
/// @param axis          unit
/// @param coefficients  n² numbers, written
void rotateZonal(std::span<const double> zonal, const Vec3d& axis, std::span<double> coefficients);

/// The transfer vector of an unshadowed diffuse receiver: (1/π) max(⟨n, ω⟩, 0) projected (C6).
///
/// @param normal    unit
/// @param transfer  n² numbers, written
void unshadowedTransfer(const Vec3f& normal, int bandCount, std::span<float> transfer);

}  // namespace prt
