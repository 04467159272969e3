#pragma once

#include "prt/light/lighting.h"

namespace prt {

/// The same radiance from everywhere: L_00 = √(4π) L, the rest 0.
Lighting uniformLighting(const Vec3d& radiance, int bandCount);

/// Light from one direction, of no extent: L_i = E y_i(direction).
///
/// @param direction   unit, towards the light
/// @param irradiance  E, on a surface facing it
Lighting directionalLighting(const Vec3d& direction, const Vec3d& irradiance, int bandCount);

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

/// A sphere of constant radiance at a distance, seen as a disc of half angle asin(radius /
/// distance); from inside it is uniform.
///
/// @param center  from the receiver, not at it unless the receiver is inside
/// @param radius  above 0, in the unit of `center`
Lighting sphereLighting(const Vec3d& center, double radius, const Vec3d& radiance, int bandCount);

/// A sky over a ground, each of constant radiance, which gives a surface of normal n and albedo 1
/// the radiance ½(1 + n·up) sky + ½(1 − n·up) ground.
///
/// @param up  unit
Lighting hemisphereLighting(const Vec3d& up, const Vec3d& skyRadiance, const Vec3d& groundRadiance,
                            int bandCount);

/// Radiance that goes linearly with height, ½(1 + ω·up) top + ½(1 − ω·up) bottom: exact in 2 bands.
///
/// @param up  unit
Lighting gradientLighting(const Vec3d& up, const Vec3d& topRadiance, const Vec3d& bottomRadiance,
                          int bandCount);

}  // namespace prt
