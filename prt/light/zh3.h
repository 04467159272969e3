#pragma once

#include <array>

#include "prt/light/lighting.h"

namespace prt {

/// Three bands of light in 15 numbers instead of 27: of the second degree only what is zonal about
/// the direction in which the luminance of the first degree is largest [Roughton24].
///
///   L_2m ≈ √(4π/5) z y_2m(axis)
///
/// The axis follows from the first degree, so it turns and blends with it and is not stored. Exact
/// for any light that is the same about one axis, such as a disc before a uniform sky.
struct Zh3 {
    std::array<Vec3d, 4> linear{};  ///< L of the first two bands, as in Lighting
    Vec3d zonal{0.0, 0.0, 0.0};     ///< z of red, green and blue
};

/// Unit; +z where the light has no direction.
Vec3d zonalAxis(const Zh3& light);

/// The z of least squared error, for the linear coefficients as they are.
///
/// Differs from the paper, which can also move those for less error in all nine.
///
/// @param lighting  at least three bands; those beyond go unused
Zh3 compressToZh3(const Lighting& lighting);

/// Guesses the second degree from the first two bands, by a fit to what is common [Roughton24]:
///
///   z = L_00 (0.08 r + 0.6 r²)        r = |first degree along the axis| / L_00
///
/// in radiance: of irradiance the ratio would be 2/3 of that. 0 where L_00 is not positive.
///
/// @param lighting  at least two bands; those beyond go unused
Zh3 hallucinateZh3(const Lighting& lighting);

/// The three bands that it stands for.
Lighting expandZh3(const Zh3& light);

/// Irradiance of a surface, Σ A_l L_lm y_lm(n), not divided by π; W·m⁻².
///
/// @param normal  unit
Vec3d evaluateIrradiance(const Zh3& light, const Vec3d& normal);

}  // namespace prt
