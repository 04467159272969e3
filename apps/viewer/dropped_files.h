#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/viewer/view_state.h"

namespace prt::viewer {

struct DropOptions {
    bool replacesLights = true;  ///< rather than add to them
};

/// Does to a view what files are for: images, folders of them and coefficients become lights,
/// assets objects, and a saved view takes the place of all. Of several lights the first may replace
/// what is there, the others are added.
///
/// @return  a sentence a file: what has become of it
std::vector<std::string> dropFiles(ViewState& view, std::span<const std::string> files,
                                   const DropOptions& options = {});

}  // namespace prt::viewer
