#pragma once

#include "prt/image/image.h"

namespace prt {

/// How far a picture is from another, in their own units.
struct ImageError {
    double rmse = 0.0;  ///< root of the mean squared difference over all pixels and channels
    double relativeRmse = 0.0;  ///< the same over the root mean square of the reference; 0 if equal
};

/// @param image, reference  of the same size, linear radiance
ImageError measureError(const Image& image, const Image& reference);

/// Peak signal-to-noise ratio of pictures for the screen, in decibels:
///
///   PSNR = 20 log₁₀(255 / RMSE of the code values), alpha aside; ∞ for equal pictures
double measurePsnr(const Rgba8Image& image, const Rgba8Image& reference);

}  // namespace prt
