#pragma once

#include "prt/image/image.h"
#include "prt/light/lighting.h"

namespace prt {

/// Projects a lat-long image onto SH as if each texel were constant, which is exact up to the
/// rounding of doubles.
///
/// About the axis +y the functions are products of one of azimuth and one of polar angle. So a row
/// costs 2n − 1 sums, not n², and a quarter of the products, since four texels share the values of
/// the azimuth functions; rows at θ and π − θ share those of the polar functions.
///
/// @param image      every texel finite; any size
/// @param bandCount  n ≥ 1
Lighting projectLatLong(const Image& image, int bandCount);

}  // namespace prt
