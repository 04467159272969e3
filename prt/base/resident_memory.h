#pragma once

#include <cstdint>

namespace prt {

/// Memory that this process holds now; 0 where the system does not say.
std::uint64_t residentBytes();

/// Gives memory that was freed back to the system, where the allocator keeps it.
void releaseFreeMemory();

}  // namespace prt
