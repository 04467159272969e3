#pragma once

#include "prt/gpu/gl_name.h"
#include "prt/light/environment.h"

namespace prt {

/// The texture that shaders/lat_long.frag looks up.
///
/// @param environment  a lat-long map
/// @throws Error       limitExceeded for one larger than the driver takes, outOfMemory
GlName uploadLatLong(const Environment& environment);

}  // namespace prt
