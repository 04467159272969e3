#pragma once

#include <string>
#include <string_view>

#include "prt/scene/scene.h"

namespace prt {

/// Reads a PLY file held in memory, as readPly does.
///
/// @param name    how to call it in an error
/// @throws Error  as readPly
Scene parsePly(std::string_view file, const std::string& name);

}  // namespace prt
