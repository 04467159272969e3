#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "prt/transfer/coefficient_table.h"
#include "prt/transport/bake.h"
#include "prt/transport/gather.h"
#include "prt/transport/matrix_plan.h"

namespace prt {

/// The options of the gather that a bake asks for.
GatherOptions gatherOptionsOf(const BakeOptions& options);

/// How many receivers one thread takes at a time.
///
/// @param inFiles  whether their work is kept in a file: then half a million rays, which takes a
///                 core a tenth of a second, and more where there would be ten thousands of files
std::size_t receiversPerUnit(std::size_t receiverCount, std::size_t sampleCount, bool inFiles);

/// Receivers that have another side: if any back is met, all may be.
std::size_t countDoubleSided(const GatherScene& scene);

/// How a bake divides the memory it may use; what has no room goes to disk.
struct MemoryPlan {
    TableStorage tables{};                ///< for the transfer of all receivers
    std::size_t blocksAtOnce = SIZE_MAX;  ///< of columns, in a bounce (BounceOptions)
    std::size_t hitBytes = SIZE_MAX;      ///< for hits
};

struct BakePlan {
    BakeForecast forecast;
    MemoryPlan memory;
    MatrixPlan matrices;
};

/// Foresees what a bake takes, from what the rays of one receiver in a thousand meet, and divides
/// the memory: first what a bounce gathers from, whose lack would have it read the hits again and
/// again, then the tables of transfer, then the hits.
///
/// Hits are the unknown: an open plane has none, a room has as many as rays. A scene of fewer than
/// a thousand receivers counts as having none: its bake is small either way.
///
/// @param scene   ready: what the process holds by now stays
/// @param units   if only these are made: nothing is held in memory once they are written
BakePlan planBake(const GatherScene& scene, const BakeOptions& options, Isa isa,
                  std::optional<UnitRange> units = {});

}  // namespace prt
