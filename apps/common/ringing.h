#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "prt/light/lighting.h"

namespace prt::cli {

/// The names of windows, and of none.
inline constexpr std::array<std::string_view, 4> kWindowNames = {"none", "hann", "lanczos", "auto"};

/// A light whose ringing is lowered.
///
/// @param window     one of kWindowNames
/// @param findLeast  the factors of "auto", one a band
Lighting lowerRinging(const Lighting& lighting, const std::string& window,
                      const std::function<std::vector<double>()>& findLeast);

}  // namespace prt::cli
