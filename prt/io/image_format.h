#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
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

/// Runs a decoder that a damaged file may crash, in a process of its own (confined.h) if the limits
/// say so: what it makes must go to SharedMemory.
///
/// @param pixelCount  how many pixels it decodes
/// @throws Error      what it throws, and as runConfined
void runDecoder(const std::function<void()>& decode, std::size_t pixelCount,
                const ImageLimits& limits, const std::string& name);

}  // namespace prt
