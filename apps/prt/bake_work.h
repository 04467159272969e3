#pragma once

#include "apps/prt/bake_options.h"

namespace prt::cli {

/// Bakes from file to file.
void bakeToAsset(BakeArguments arguments);

/// Makes some units of a bake into its checkpoint.
void bakeShare(BakeArguments arguments, UnitRange units);

}  // namespace prt::cli
