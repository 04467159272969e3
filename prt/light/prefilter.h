#pragma once

#include <vector>

#include "prt/light/environment.h"

namespace prt {

/// How a rough mirror spreads what it reflects about the mirrored direction r; α = roughness² as in
/// glTF. The lobes have the same curvature at r, and both are the clamped cosine at roughness 1.
enum class ReflectionLobe {
    ggx,    ///< D(h) ⟨n, l⟩⁺ with n = v = r [Karis13], D of [Walter07, eq. 33]
    phong,  ///< (⟨r, l⟩⁺)^s with s = 1/α²
};

struct PrefilterOptions {
    int faceSize = 128;
    std::vector<double> roughnesses = {0.0, 0.2, 0.4, 0.6, 0.8, 1.0};  ///< each in [0, 1]
    ReflectionLobe lobe = ReflectionLobe::ggx;
    int sampleCount = 512;  ///< directions a texel
};

/// What mirrors and matt surfaces show of an environment, without their shadow on themselves.
/// All are vertical strips.
struct PrefilteredEnvironment {
    std::vector<Environment> mirrors;  ///< one a roughness, looked up in the mirrored direction
    Environment diffuse;               ///< irradiance / π, looked up in the normal
};

/// Averages an environment over a lobe about each direction:
///
///   ∫ L(l) lobe(l) dl / ∫ lobe(l) dl
///
/// with directions drawn in proportion to the lobe, evenly spread and the same about every texel,
/// each looked up in a copy of the environment whose texels are as wide as the gap to the next few
/// directions, so that small suns leave no specks [Krivanek08]. Roughness 0 is the environment
/// itself, resampled.
///
/// @param environment  every texel finite; negative radiance counts as any other
PrefilteredEnvironment prefilterEnvironment(const Environment& environment,
                                            const PrefilterOptions& options = {});

}  // namespace prt
