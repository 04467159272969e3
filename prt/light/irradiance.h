#pragma once

#include <array>
#include <vector>

#include "prt/light/lighting.h"

namespace prt {

/// Irradiance as a function of the surface's normal, in the basis of the light:
///
///   E_lm = A_l L_lm        with A_l the clampedCosineFactor                      [Ramamoorthi01]
///
/// W·m⁻², and not divided by π: a diffuse surface reflects albedo · E / π.
Lighting convolveWithCosine(const Lighting& lighting);

/// Irradiance of a surface, E(n) = Σ A_l L_lm y_lm(n), from all bands of the light; W·m⁻².
///
/// @param normal  unit
Vec3d evaluateIrradiance(const Lighting& lighting, const Vec3d& normal);

/// The symmetric 4×4 matrix M that irradiance from nine coefficients is a quadratic form of,
/// E(n) = (n, 1)ᵀ M (n, 1) [Ramamoorthi01]; each entry holds red, green and blue.
using IrradianceMatrix = std::array<std::array<Vec3d, 4>, 4>;

/// The matrix of the first three bands; what bands the light lacks are 0.
///
/// Differs from the paper: the signs are those of our basis (C2), and the constants are exact where
/// the published c2 and c3 are off in the sixth digit.
IrradianceMatrix makeIrradianceMatrix(const Lighting& lighting);

/// @param normal  unit
Vec3d evaluateIrradiance(const IrradianceMatrix& matrix, const Vec3d& normal);

/// How far irradiance from the first bands of a light is off over all normals, in luminance and as
/// a fraction of the largest irradiance.
struct IrradianceError {
    int bandCount = 0;
    double mean = 0.0;  ///< of the absolute value
    double rms = 0.0;
    double largest = 0.0;
};

/// Measures what 1, 2, … maxBandCount bands leave of irradiance.
///
/// The light given is the truth, so it has to have many bands. A directional light, the worst there
/// is, holds an average of 0.2 % of its peak beyond 20 bands, and 0.05 % beyond 40.
///
/// @param maxBandCount  at most lighting.bandCount
/// @return              all 0 where there is no light
std::vector<IrradianceError> measureIrradianceErrors(const Lighting& lighting,
                                                     int maxBandCount = 3);

/// The same of light from one direction, the worst there is, against the clamped cosine itself: of
/// nine coefficients 3.07 % on average, and 9.375 % at the most, edge-on.
std::vector<IrradianceError> worstIrradianceErrors(int maxBandCount = 3);

}  // namespace prt
