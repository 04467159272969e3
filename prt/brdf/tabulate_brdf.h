#pragma once

#include "prt/brdf/brdf.h"

namespace prt {

/// A BRDF as if it had been measured: each cell holds the value at its middle, in θ_h's own steps
/// too, and 0 where ω_i or ω_o would lie below the horizon. What no float holds becomes the largest
/// one.
MeasuredBrdf tabulateBrdf(const Brdf& brdf);

}  // namespace prt
