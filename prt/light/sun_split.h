#pragma once

#include <optional>

#include "prt/light/environment.h"

namespace prt {

/// A disc of light at infinity; discLighting projects it.
struct DiscLight {
    Vec3d direction{0.0, 1.0, 0.0};  ///< unit, towards the disc's centre
    double halfAngleRadians = 0.0;
    Vec3d radiance{0.0, 0.0, 0.0};  ///< W·sr⁻¹·m⁻², on top of the sky that stays behind it
};

struct SunSplitOptions {
    double edgeFraction = 0.1;           ///< a sun ends where less than this of its peak is left
    double maxHalfAngleRadians = 0.175;  ///< what is larger, 10°, is no sun
};

/// An environment as a sun, where it has one, and the rest.
struct SunSplit {
    std::optional<DiscLight> sun;
    Environment rest;
};

/// Takes the sun out of an environment, for a renderer to treat by itself.
///
/// The sun is what hangs together with the brightest texel and exceeds a fraction of its luminance,
/// with a rim of one texel. It is replaced by the mean radiance around it, and what that takes away
/// becomes a disc: its direction is the mean by luminance, its radiance that of the sun's
/// face, its flux what was taken, and its solid angle what follows. So sun and rest have the flux
/// of the environment. Light that is alike everywhere, an overcast sky and a black one have no sun.
///
/// @param environment  every texel finite and not negative
SunSplit splitSun(const Environment& environment, const SunSplitOptions& options = {});

/// A directional light, and the lighting without it.
struct DominantLight {
    Vec3d direction{0.0, 1.0, 0.0};   ///< unit, towards the light
    Vec3d irradiance{0.0, 0.0, 0.0};  ///< of a surface that faces it
    Lighting rest;
};

/// Takes the directional light that explains most out of lighting, where all that is known are
/// coefficients [Sloan08].
///
/// Its direction is that of the luminance of degree 1, (−L_11, −L_1−1, L_10); its irradiance the
/// least squares fit to the coefficients of a directional light plus an ambient one, kept from 0 to
/// what leaves no channel's mean negative. sunLighting(direction, 0, n) times the irradiance plus
/// the rest is the lighting.
///
/// @return  nothing for lighting without degree 1
std::optional<DominantLight> extractDominantLight(const Lighting& lighting);

}  // namespace prt
