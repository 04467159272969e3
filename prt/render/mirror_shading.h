#pragma once

#include <vector>

#include "prt/brdf/specular_albedo.h"
#include "prt/light/prefilter.h"
#include "prt/math/transform.h"
#include "prt/scene/surface_color.h"

namespace prt {

/// What mirror-like surfaces show of light from infinity, nothing standing in between.
struct MirrorEnvironment {
    std::vector<double> roughnesses;   ///< ascending from 0, at least two
    std::vector<Environment> mirrors;  ///< one a roughness (PrefilteredEnvironment)
    Mat3d worldFromEnvironment{};      ///< a rotation: L(R⁻¹ω)
    SpecularAlbedoTable albedos{};
};

struct MirrorOptions {
    double mostRoughness = 1.0;  ///< in (0, 1]; rougher surfaces count as so rough
    int faceSize = 64;           ///< as that of PrefilterOptions
    int sampleCount = 512;
    int threadCount = 0;  ///< 0: one a core
};

/// Prefilters an environment for mirrors of every roughness. That of 0 shows it as it is.
///
/// @param environment  every texel finite
MirrorEnvironment makeMirrorEnvironment(Environment environment,
                                        const Mat3d& worldFromEnvironment = {},
                                        const MirrorOptions& options = {});

/// The light of an environment that the specular lobe of a glTF material sends to the eye, by the
/// mean of the light over a lobe about the mirrored view r and the share of it that is reflected:
///
///   S(r, roughness) ∫ f_r(ω_i, ω_o) max(cos θ_i, 0) dω_i                              [Karis13]
///
/// @param normal  unit, of shading, world space, on the side that is seen
/// @param view    ω_o, unit, world space; raised where the normal leans away (makeReflection)
Vec3f showMirrored(const MirrorEnvironment& environment, const Vec3f& normal, const Vec3f& view,
                   const Vec3f& baseColor, const MetallicRoughness& surface);

}  // namespace prt
