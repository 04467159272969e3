#pragma once

#include "prt/image/image.h"
#include "prt/image/sphere_map.h"
#include "prt/light/lighting.h"

namespace prt {

/// Radiance from every direction at infinity, as an image (C4, C5).
struct Environment {
    SphereMap map = SphereMap::latLong;
    Image radiance;
};

/// How many texels the policy for bad values touched, and what became of their bad channels.
struct SanitiseReport {
    std::size_t nanCount = 0;       ///< texels with a NaN: 0
    std::size_t infiniteCount = 0;  ///< texels with +∞: the largest finite value of the image
    std::size_t negativeCount = 0;  ///< texels with a negative channel, −∞ included: 0
};

/// Makes every texel finite and non-negative.
SanitiseReport sanitise(Image& radiance);

/// Projects an environment onto SH.
///
///   L_i = ∫ L(ω) y_i(ω) dω                                                  [Ramamoorthi01, eq. 3]
///
/// Lat-long texels are integrated exactly as patches of constant radiance, so a constant
/// environment gives √(4π) L in L_00 and zeros to rounding. Texels of other maps count with their
/// exact solid angle, normalised to sum to 4π, times y_i at their centre. Sums are in double, in a
/// fixed order (C10).
///
/// @param environment  every texel finite
/// @param bandCount    n ≥ 1
Lighting projectLighting(const Environment& environment, int bandCount);

/// Radiance in a direction, bilinear between texel centres (see bilinearTexels).
///
/// @param direction  unit, world space
Vec3f lookUpRadiance(const Environment& environment, const Vec3f& direction);

/// Adds a disc of light to an image, in the texels that it touches, by what they show of it. All
/// goes into the texel of its centre where it slips between the places that are tried.
///
/// @param direction         unit, towards the disc's centre
/// @param halfAngleRadians  in [0, π]
/// @param flux              ∫ L dω over the disc, which is kept whatever the texels
void addDisc(Environment& environment, const Vec3d& direction, double halfAngleRadians,
             const Vec3d& flux);

/// Draws what the coefficients stand for as a lat-long image, negative lobes included.
///
/// @param width  even
Image reconstructLatLong(const Lighting& lighting, int width);

}  // namespace prt
