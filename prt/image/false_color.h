#pragma once

#include <array>
#include <span>

#include "prt/image/image.h"

namespace prt {

/// Colours for −1 … 1, evenly spaced: dark blue, white at 0, dark red.
std::span<const Rgba8> signedColors();

/// Colours for −1 … 1, evenly spaced, for surfaces: black at 0, and as bright for −x as for x,
/// whose lightness L* they grow with; blue to pale cyan below, red to pale yellow above.
std::span<const Rgba8> signedColorsOnBlack();

/// Colours for 0 … 1, evenly spaced, from dark to bright: black, violet, red, yellow, white.
std::span<const Rgba8> unitColors();

/// Draws numbers in colours. Values beyond the ends have the colour of the end.
///
/// @param low, high  the values of the first and of the last colour; low < high
/// @param colors     at least two
Rgba8Image drawFalseColors(const ImageOf<float>& values, float low, float high,
                           std::span<const Rgba8> colors);

/// The same of one number: the radiance that shows as its colour where neither exposure nor a tone
/// curve changes it.
Vec3f findFalseRadiance(float value, float low, float high, std::span<const Rgba8> colors);

}  // namespace prt
