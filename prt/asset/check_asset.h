#pragma once

#include <string>
#include <vector>

#include "prt/asset/asset.h"

namespace prt {

/// What is doubtful in an asset that readAsset accepts, one sentence each; empty for a sound bake.
///
/// Radiance is never negative, and reflectances up to 1 return no more light than comes in. So
/// whatever the scene, a coefficient of degree l is at most √((2l+1)/4π) in magnitude, and the
/// mean, l = 0, is in [0, 0.2821]. A mean of 0 is a vertex that no light reaches, which is an
/// honest result for few of them and a sign of an inside-out mesh for many.
std::vector<std::string> findAssetProblems(const Asset& asset);

}  // namespace prt
