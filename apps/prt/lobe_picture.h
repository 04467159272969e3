#pragma once

#include "prt/brdf/brdf.h"
#include "prt/image/image.h"

namespace prt::cli {

/// Two views straight down onto the directions above a surface: how brightly light from each is
/// seen by an eye 45° to the right, f_r cos θ_i; and beside it what n bands make of that, fitted
/// above the horizon. 1 is the brightest of the left one.
Image drawLobe(const Brdf& brdf, int bandCount);

}  // namespace prt::cli
