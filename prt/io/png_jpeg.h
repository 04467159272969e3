#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "prt/io/image_format.h"

namespace prt {

/// Decodes a PNG or JPEG to 8 bits a channel.
///
/// @throws Error  malformed or limitExceeded
Rgba8Image decodePngOrJpeg(std::span<const std::byte> encoded, ImageFormat format,
                           const std::string& name, const ImageLimits& limits);

/// The same as linear RGB, with all 16 bits of a 16-bit PNG; alpha is ignored.
Image decodePngOrJpegLinear(std::span<const std::byte> encoded, ImageFormat format,
                            const std::string& name, const ImageLimits& limits);

}  // namespace prt
