#pragma once

#include <filesystem>
#include <string_view>

#include "prt/scene/scene.h"

namespace prt {

/// Reads an OBJ file held in memory, as readObj does.
///
/// @param path    how to call it in an error; its libraries and textures lie in this path's folder
/// @throws Error  as readObj
Scene parseObjScene(std::string_view text, const std::filesystem::path& path);

}  // namespace prt
