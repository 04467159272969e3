#pragma once

#include <functional>
#include <vector>

#include "prt/basis/sh.h"

namespace prt {

/// Projects a function onto SH.
///
///   c_i = ∫ f(ω) y_i(ω) dω over the sphere                                             [Sloan08]
///
/// Exact to rounding for polynomials in x, y, z, and so for any function of few bands; of smooth
/// functions the error falls fast with the degree, of others slowly.
///
/// @param function   f of a unit direction; called once at each of (degree + n)² / 2 nodes or so
/// @param bandCount  n ≥ 1
/// @param degree     up to which f is treated exactly
/// @return           n² coefficients
std::vector<double> projectSh(const std::function<double(const Vec3d&)>& function, int bandCount,
                              int degree);

}  // namespace prt
