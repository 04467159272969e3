#pragma once

#include <functional>
#include <string>
#include <vector>

#include "prt/light/lighting.h"

namespace prt::cli {

/// A light whose ringing is lowered.
///
/// @param window     none, hann, lanczos or auto
/// @param findLeast  the factors of "auto", one a band
Lighting lowerRinging(const Lighting& lighting, const std::string& window,
                      const std::function<std::vector<double>()>& findLeast);

}  // namespace prt::cli
