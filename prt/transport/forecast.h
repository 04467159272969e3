#pragma once

#include <optional>

#include "prt/transport/bake.h"
#include "prt/transport/gather.h"

namespace prt {

/// Foresees what a bake takes, from what the rays of one receiver in a thousand meet.
///
/// Hits are the unknown: an open plane has none, a room has as many as rays. A scene of fewer than
/// a thousand receivers counts as having none: its bake is small either way.
///
/// @param units  if only these are made: nothing is held in memory once they are written
BakeForecast forecastBake(const GatherScene& scene, const BakeOptions& options, Isa isa,
                          std::optional<UnitRange> units = {});

}  // namespace prt
