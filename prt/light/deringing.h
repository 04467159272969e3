#pragma once

#include <vector>

#include "prt/light/lighting.h"

namespace prt {

/// What of a light must not be negative in any direction.
enum class NonNegative {
    radiance,    ///< the light itself
    irradiance,  ///< what a surface of any normal receives of it: less smoothing is enough
};

struct DeringingOptions {
    NonNegative nonNegative = NonNegative::radiance;
};

/// The least Laplacian smoothing under which no channel is negative anywhere, the same for the
/// three channels so that hue holds [Sloan17]. Identity for lighting that has no negative lobes.
///
/// The least is the first λ of the window, going up from 0; what is negative by less than 1e-10 of
/// the mean counts as rounding. A channel whose mean is not positive cannot be helped and is left
/// out.
///
/// @param lighting  every coefficient finite
/// @return          one factor a band, the first 1
std::vector<double> deringingFactors(const Lighting& lighting,
                                     const DeringingOptions& options = {});

}  // namespace prt
