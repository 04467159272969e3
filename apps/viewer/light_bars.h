#pragma once

#include <vector>

#include "prt/light/lighting.h"

namespace prt::viewer {

/// The energy of each band of a light, ∫ of the square of what the band adds to its radiance:
///
///   E_l = Σ_m L_lm²
///
/// one a channel; a rotation keeps it.
std::vector<Vec3d> bandEnergies(const Lighting& lighting);

}  // namespace prt::viewer
