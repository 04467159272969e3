#pragma once

#include <filesystem>
#include <string>

#include "prt/image/image.h"

namespace prt::viewer {

/// What is in the window's framebuffer, whose size is given.
Rgba8Image readWindow(int width, int height);

/// The first of prt_001, prt_002 … of which the folder has neither a .png nor an .exr; without
/// suffix.
std::filesystem::path nextScreenshot(const std::filesystem::path& folder);

}  // namespace prt::viewer
