#pragma once

#include <string>

#include "apps/prt/stage_log.h"
#include "prt/asset/asset.h"
#include "prt/io/image_io.h"

namespace prt::cli {

/// readShownAsset, its warnings passed on.
///
/// @param limits  of its textures
Asset readPreparedAsset(const std::string& path, const ImageLimits& limits, StageLog& log);

}  // namespace prt::cli
