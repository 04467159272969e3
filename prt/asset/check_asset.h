#pragma once

#include <string>
#include <vector>

#include "prt/asset/asset.h"

namespace prt {

/// What is doubtful in an asset that readAsset accepts, one sentence each; empty for a sound bake.
///
/// Radiance is never negative, and reflectances up to 1 return no more light than comes in. So
/// whatever the scene, a coefficient of degree l is at most √((2l+1)/4π) in magnitude, and the
/// mean, l = 0, is in [0, 0.2821].
///
/// A matrix M_ij holds how light arrives, no brighter than |y_j| ≤ √((2l+1)/4π), l the degree of j;
/// and ∫ y_i² = ½ over any hemisphere. So by the Cauchy-Schwarz inequality |M_ij| ≤ ½ √(2l+1), and
/// by visibility alone ½; M_00 is in [0, ½]. Where light bounced off materials of glTF, twice as
/// much is let pass: these may reflect more than comes in. Elements are sums over rays, and may
/// exceed this by six standard deviations, that of an element being no more than its bound over the
/// root of the number of rays (by visibility ½ √(2l+1), l the lower degree of i and j).
///
/// A mean of 0 is a vertex that no light reaches, which is an honest result for few of them and a
/// sign of an inside-out mesh for many.
std::vector<std::string> findAssetProblems(const Asset& asset);

}  // namespace prt
