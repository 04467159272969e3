#pragma once

#include <span>
#include <vector>

#include "prt/relight/exit_radiance.h"

namespace prt {

/// Shows radiance that may be negative in false colours (signedColorsOnBlack): under
/// makeBasisLighting, a coefficient of transfer. A vertex has the colour of Y over the largest |Y|
/// of all, Y the luminance that it would have if its base colour were white.
///
/// @param vertexRadiance  of every vertex
/// @return                the colours as `constant`, so that no base colour changes them, for
///                        pictures that are shown without exposure and tone curve
std::vector<ExitRadiance> showSignedRadiance(std::span<const ExitRadiance> vertexRadiance);

}  // namespace prt
