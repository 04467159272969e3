#pragma once

#include <array>

#include "prt/transport/checkpoint.h"
#include "prt/transport/gather_unit.h"

namespace prt::fuzz {

// The unit that the checkpoint target reads, and that its seeds are written for.

inline constexpr std::uint64_t kWorkFingerprint = 42;
inline constexpr std::array<std::uint32_t, 2> kUnitReceivers = {3, 4};

inline UnitKey unitKey() {
    return {.stage = "fronts", .index = 1, .begin = 3, .end = 5};
}

inline GatherUnitShape unitShape() {
    return {.receivers = kUnitReceivers, .coefficientCount = 4, .receiverLimit = 8};
}

}  // namespace prt::fuzz
