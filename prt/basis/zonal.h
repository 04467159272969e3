#pragma once

#include <functional>
#include <span>
#include <vector>

#include "prt/math/vector.h"

namespace prt {

/// What irradiance multiplies degree l of radiance by, E_lm = A_l L_lm, in closed form
/// [Ramamoorthi01, eq. 7 and 8]: π, 2π/3, π/4, 0, −π/24, 0, π/64, …
double clampedCosineFactor(int l);

/// Zonal coefficients of the clamped cosine, c_l = ∫ max(cos θ, 0) y_l0 dω = A_l √((2l+1)/4π).
std::vector<double> clampedCosineZonal(int bandCount);

/// Zonal coefficients of unit radiance from a disc of the given half angle about +z, in closed form
/// [Sloan08, appendix A3].
///
/// @param halfAngleRadians  in [0, π]
std::vector<double> capZonal(int bandCount, double halfAngleRadians);

/// Zonal coefficients of a Phong lobe, (s + 1)/(2π) max(cos θ, 0)^s, in closed form: its integral
/// over the sphere is 1, and s = 1 is the clamped cosine over π.
///
/// @param exponent  s ≥ 0; need not be whole
std::vector<double> phongZonal(int bandCount, double exponent);

/// Zonal coefficients of a Gaussian lobe of the sphere, λ/(2π (1 − e^(−2λ))) e^(λ (cos θ − 1)): its
/// integral over the sphere is 1 [Fisher53]. They are √((2l+1)/4π) times a ratio of modified
/// spherical Bessel functions, i_l(λ) / i_0(λ).
///
/// @param sharpness  λ ≥ 0, finite; 0 is the same everywhere, and 1/√λ radians its width
std::vector<double> gaussianZonal(int bandCount, double sharpness);

/// Zonal coefficients of any function of the angle to +z, z_l = 2π ∫ f(z) y_l0(z) dz, by
/// Gauss-Legendre quadrature: exact for polynomials of degree 2·nodeCount − bandCount.
///
/// @param function   of z = cos θ in [−1, 1]
/// @param nodeCount  at least bandCount
std::vector<double> projectZonal(const std::function<double(double)>& function, int bandCount,
                                 int nodeCount = 64);

/// Convolves a function with a kernel that is the same about every direction, what irradiance is of
/// radiance: (h ∗ f)_lm = √(4π/(2l+1)) h_l f_lm [Ramamoorthi01].
///
/// @param kernel        zonal, n coefficients
/// @param coefficients  n² numbers
/// @param convolved     n² numbers, written; may be the same as `coefficients`
void convolveZonal(std::span<const double> kernel, std::span<const double> coefficients,
                   std::span<double> convolved);

/// Turns a zonal function about +z to another axis: c_lm = √(4π/(2l+1)) z_l y_lm(axis) [Sloan08].
///
/// @param zonal         n coefficients, one a band
/// @param axis          unit
/// @param coefficients  n² numbers, written
void rotateZonal(std::span<const double> zonal, const Vec3d& axis, std::span<double> coefficients);

/// The direction in which the first degree of a function is largest, the best axis that its first
/// two bands have [Sloan05]; +z where that degree is 0.
///
/// @param firstDegree  coefficients 1, 2 and 3
/// @return             unit
Vec3d optimalLinearDirection(std::span<const double, 3> firstDegree);

/// The transfer vector of an unshadowed diffuse receiver: (1/π) max(⟨n, ω⟩, 0) projected (C6).
///
/// @param normal    unit
/// @param transfer  n² numbers, written
void unshadowedTransfer(const Vec3f& normal, int bandCount, std::span<float> transfer);

}  // namespace prt
