#pragma once

#include "prt/light/environment.h"
#include "prt/math/transform.h"

namespace prt {

/// Draws an environment in another layout or size.
///
/// Where texels grow, each becomes the mean of the radiance over its solid angle; where they
/// shrink, radiance lies bilinearly between the centres of the source. Flux is kept: what a source
/// texel gives to all texels together is scaled to its solid angle, so that a sun of one texel
/// neither gets lost nor grows, and ∫ L dω changes by less than 1e-3; where texels are whole blocks
/// of a lat-long map's, by rounding alone. A constant stays constant.
///
/// @param source         every texel finite
/// @param width, height  of the result; they have the shape of its map
/// @return               0 where the map shows nothing
Environment resample(const Environment& source, SphereMap map, int width, int height);

/// The environment as a lat-long map whose texels are about as fine; one that is stays as it is.
Environment resampleAsLatLong(Environment source);

/// The environment turned as rotate() turns its coefficients, L(R⁻¹ω), and resampled once.
///
/// @param rotation  orthogonal (C9)
Environment rotate(const Environment& source, const Mat3d& rotation, SphereMap map, int width,
                   int height);

/// The same in the layout and size that it has.
Environment rotate(const Environment& source, const Mat3d& rotation);

}  // namespace prt
