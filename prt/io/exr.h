#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "prt/io/image_io.h"

namespace prt {

/// Decodes the data window of an OpenEXR file's first part as float: channels R G B (0
/// where one is missing), or Y as grey, or the first layer's R G B. Scan lines or tiles
/// (the finest level), any compression.
///
/// @throws Error  malformed, unsupported (deep or subsampled data, other channels) or limitExceeded
Image decodeExr(std::span<const std::byte> encoded, const std::string& name,
                const ImageLimits& limits);

/// Channels R G B as 32-bit float, ZIP compressed.
std::vector<std::byte> encodeExr(const Image& image);

/// The data window of an image.
struct ExrSize {
    int width = 0;
    int height = 0;
};

/// Refuses an OpenEXR file whose headers ask for more than the limits or more than the
/// file can hold, with none of OpenEXR's own code involved: it allocates what a header
/// says before it reads any pixel.
///
/// @return        the size of the first part
/// @throws Error  malformed or limitExceeded
ExrSize checkExrHeaders(std::span<const std::byte> encoded, const std::string& name,
                        const ImageLimits& limits);

}  // namespace prt
