#pragma once

#include "prt/math/vector.h"

namespace prt {

/// What a receiver sends to the eye, W·sr⁻¹·m⁻²: base colour · perBaseColor + constant, and the
/// light that a mirror-like surface shows of the environment. Apart, so that a texture is seen as
/// finely as it is, and the environment too.
struct ExitRadiance {
    Vec3f perBaseColor{0.0f, 0.0f, 0.0f};
    Vec3f constant{0.0f, 0.0f, 0.0f};
    /// How much of the specular light that comes straight from the environment arrives, 0 … 1: the
    /// picture adds so much of the prefiltered environment in the mirrored direction. 0 where the
    /// bands hold the lobe, which is then in the other two.
    float mirrorVisibility = 0.0f;
};

}  // namespace prt
