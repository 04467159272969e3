#pragma once

#include <string>
#include <utility>
#include <vector>

namespace prt::fuzz {

/// Small EXR images written by OpenEXR itself: each compression as scan lines, and tiles, levels
/// and several parts; with their names.
std::vector<std::pair<std::string, std::string>> makeExrSeeds();

}  // namespace prt::fuzz
