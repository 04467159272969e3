#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "prt/io/image_io.h"

namespace prt {

/// Decodes a Radiance picture: flat or run-length encoded RGBE, rows from
/// the top, columns from the left.
///
/// A channel is mantissa · 2^(exponent − 136), without the half that Radiance itself adds; the
/// EXPOSURE of the header is not applied.
///
/// @throws Error  malformed, unsupported (XYZE, other pixel orders) or limitExceeded
Image decodeRadianceHdr(std::span<const std::byte> encoded, const std::string& name,
                        const ImageLimits& limits);

}  // namespace prt
