#pragma once

#include <string>
#include <string_view>

#include "prt/image/image.h"
#include "prt/image/tone_curve.h"
#include "prt/light/lighting.h"

namespace prt::cli {

/// The formats that writePicture knows.
inline constexpr std::string_view kPictureSuffixes = ".exr .png";

/// Whether the name asks for linear radiance rather than a picture for the screen.
bool isExr(const std::string& path);

/// Writes .exr as linear radiance untouched, .png as the display options
/// say. @throws Error writeFailed
void writePicture(const std::string& path, const Image& radiance,
                  const DisplayOptions& display = {});

/// The exposure in stops under which the brightest side of a white diffuse sphere comes to 0.8.
float chooseExposure(const Lighting& lighting);

}  // namespace prt::cli
