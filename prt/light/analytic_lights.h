#pragma once

#include "prt/light/lighting.h"

namespace prt {

/// The same radiance from everywhere: L_00 = √(4π) L, the rest 0.
Lighting uniformLighting(const Vec3d& radiance, int bandCount);

/// A disc of constant radiance, projected in closed form [Sloan08, appendix A3].
///
/// @param direction         unit, towards the disc's centre
/// @param halfAngleRadians  angular radius, in (0, π]
/// @param radiance          of the disc
Lighting discLighting(const Vec3d& direction, double halfAngleRadians, const Vec3d& radiance,
                      int bandCount);

/// A disc scaled to give unit irradiance to a surface that faces it, whatever its size; with half
/// angle 0 a directional light.
Lighting sunLighting(const Vec3d& direction, double halfAngleRadians, int bandCount);

}  // namespace prt
