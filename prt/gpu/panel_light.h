#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "prt/light/lighting.h"
#include "prt/relight/stored_range.h"

namespace prt {

/// A light for numbers as they are stored: scale and bias of each column are in it.
struct PanelLight {
    /// [panel][channel][4]: what a panel's four numbers are multiplied by for red, green and blue.
    std::vector<float> factors;
    std::size_t panelCount = 0;  ///< those whose factors are not all 0, and all before them
    Vec3f biasRadiance{0.0f, 0.0f, 0.0f};
};

/// @param ranges    of each column, [channel][coefficient]
/// @param lighting  with at most bandCount bands
PanelLight foldLight(std::span<const StoredRange> ranges, int bandCount, const Lighting& lighting);

}  // namespace prt
