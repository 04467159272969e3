#pragma once

#include "prt/image/image.h"

namespace prt {

/// How a picture is looked at.
struct FlipOptions {
    /// Pixels in a degree of the field of view. 67 is the paper's: a screen 3840 pixels and 0.7 m
    /// wide, 0.7 m away.
    double pixelsPerDegree = 67.0;
};

/// ꟻLIP: how large a difference a person sees who flips between two pictures for the screen, from 0
/// (none) to 1 (black against white), for each pixel [Andersson20].
///
/// Both are blurred as the eye does at that distance, compared as colours where large differences
/// count less than in proportion, and then amplified where an edge or a point is in one alone.
/// Places beyond the border look like the pixel beside them. Alpha counts for nothing.
///
/// @param image, reference  of the same size
ImageOf<float> measureFlip(const Rgba8Image& image, const Rgba8Image& reference,
                           const FlipOptions& options = {});

/// The mean over all pixels, the one number of a ꟻLIP map.
double meanValue(const ImageOf<float>& map);

}  // namespace prt
