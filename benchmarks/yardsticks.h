#pragma once

#include <cstddef>

namespace prt {

/// CPU time of this thread, from any start.
double readCpuSeconds();

/// What the machine can do at this moment, for benchmarks to print their times as multiples of.
/// Each is the least CPU time of several runs, measured at the call.

/// One multiply-add of the widest vectors, many in flight.
double measureMultiplyAddSeconds();

/// Reading a block of this size again and again.
double measureReadSeconds(std::size_t bytes);

/// Writing a block of this size again and again.
double measureStoreSeconds(std::size_t bytes);

}  // namespace prt
