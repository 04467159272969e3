#pragma once

#include <cstdint>

namespace prt::cli {

/// The most memory that this process has held.
std::uint64_t peakBytes();

/// Memory that this process can have at most: of the machine, its control group and its limits.
std::uint64_t grantedBytes();

/// Puts some memory aside for the end of memory: the first allocation that fails gives it back and
/// is tried again. What fails then is told by a sentence, and there is room to put things in order:
/// not every destructor of every library does without an allocation.
void reserveMemoryForTheEnd();

}  // namespace prt::cli
