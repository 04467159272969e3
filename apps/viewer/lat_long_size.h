#pragma once

#include "prt/image/image.h"

namespace prt::viewer {

/// A lat-long image of another size: each texel the mean of those it covers, by solid angle, as if
/// they were constant. Flux is kept; milliseconds, where resample(), which takes any two maps and
/// interpolates, needs seconds.
///
/// @param height  of the result; it is twice as wide
Image resizeLatLong(const Image& source, int height);

}  // namespace prt::viewer
