#pragma once

#include <cstdint>

namespace prt::cli {

/// The most memory that this process has held.
std::uint64_t peakBytes();

/// Memory that this process can have at most: of the machine, its control group and its limits.
std::uint64_t grantedBytes();

}  // namespace prt::cli
