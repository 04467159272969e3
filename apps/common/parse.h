#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "prt/math/transform.h"
#include "prt/math/vector.h"

namespace prt::cli {

/// Width and height of a picture, in pixels.
struct PictureSize {
    int width = 1280;
    int height = 720;
};

/// Each reads the whole text, or nothing.
std::optional<double> parseNumber(std::string_view text);              ///< finite
std::optional<std::uint64_t> parseWholeNumber(std::string_view text);  ///< not negative
std::optional<Vec3d> parseTriple(std::string_view text);               ///< "x,y,z"
std::optional<PictureSize> parsePictureSize(
    std::string_view text);  ///< "1280x720", each side 1 … 16384

/// What parseBounceCount makes of "inf", as the library does.
inline constexpr int kEveryBounce = -1;
std::optional<int> parseBounceCount(std::string_view text);  ///< 0 … 1000, or "inf"

/// Turned by so many degrees about the world's x axis, then y, then z.
Mat3d rotationFromDegrees(const Vec3d& degrees);
/// The reverse, y between −90 and 90; where y is ±90, x and z turn about one axis, and z is 0.
Vec3d degreesFromRotation(const Mat3d& rotation);

/// The path's suffix with its full stop, in lower case.
std::string lowerSuffix(const std::string& path);

/// @throws Error  invalidOption if the path does not end in one of the suffixes ".png .exr"
void requireSuffix(const std::string& path, std::string_view suffixes);

}  // namespace prt::cli
