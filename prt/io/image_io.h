#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "prt/image/image.h"
#include "prt/scene/scene.h"

namespace prt {

struct ImageLimits {
    int maxWidth = 16384;
    int maxHeight = 16384;
    std::uintmax_t maxFileBytes = std::uintmax_t(2) << 30;
    /// OpenEXR and stb_image decode in a process of their own: a file that crashes them is an
    /// Error. Without it they take a few milliseconds less, which is for files of one's own.
    bool inOwnProcess = true;
};

/// Reads .exr (any compression, as float), .hdr, .png or .jpg (decoded
/// from sRGB) as linear RGB (C5).
///
/// The format is told by the content, not the name. Values are as stored:
/// NaN, ∞ and negative ones included.
///
/// @throws Error  notFound, unreadable, malformed, unsupported, or limitExceeded
Image readImage(const std::filesystem::path& path, const ImageLimits& limits = {});

/// Decodes a PNG or JPEG held in memory.
///
/// @param name  how to call it in an error
Rgba8Image decodeImage(std::span<const std::byte> encoded, const std::string& name,
                       const ImageLimits& limits = {});

/// Decodes every image of the scene that is not yet decoded.
void decodeTextures(Scene& scene, const ImageLimits& limits = {});

std::vector<std::byte> encodePng(const Rgba8Image& image);

/// Writes atomically. @throws Error writeFailed
void writePng(const std::filesystem::path& path, const Rgba8Image& image);

/// Linear RGB as 32-bit float, ZIP compressed. Writes atomically. @throws Error writeFailed
void writeExr(const std::filesystem::path& path, const Image& image);

}  // namespace prt
