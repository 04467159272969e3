#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/transport/gather.h"

namespace prt {

/// What the gather at some receivers brings: a piece of the work that can be kept in a file.
struct GatherUnit {
    std::vector<float> transfer;  ///< [receiver][coefficient], shadowed
    HitSlab slab;                 ///< their rows of the bounce matrix; empty if hits are not kept
    GatherCounts counts;
};

/// What a unit must be, of a bake that is known.
struct GatherUnitShape {
    std::span<const std::uint32_t> receivers;  ///< that it is for
    std::size_t coefficientCount = 0;
    bool keepHits = true;
    std::size_t receiverLimit = 0;  ///< receivers are numbered below this: fronts, then backs
};

/// A unit as bytes, the same on every machine: the seconds it took are left out.
std::vector<std::byte> encodeGatherUnit(const GatherUnit& unit, const GatherUnitShape& shape);

/// @param payload  from a file: every count and index is checked
/// @throws Error   malformed if it is not of that shape
GatherUnit readGatherUnit(std::span<const std::byte> payload, const GatherUnitShape& shape);

}  // namespace prt
