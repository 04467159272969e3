#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "prt/io/image_io.h"

namespace prt {

enum class ImageFormat { exr, hdr, png, jpeg };

/// The format that the first bytes announce, or nothing.
std::optional<ImageFormat> recogniseImageFormat(std::span<const std::byte> encoded);

/// Refuses a size before anything of that size is allocated.
///
/// @throws Error  malformed for an empty image, limitExceeded for one larger than the limits
void checkImageSize(std::int64_t width, std::int64_t height, const ImageLimits& limits,
                    const std::string& name);

}  // namespace prt
