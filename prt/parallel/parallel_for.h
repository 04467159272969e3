#pragma once

#include <cstddef>
#include <functional>

namespace prt {

/// The number of threads that `threadCount` asks for: itself, or one a core when it is 0.
int resolveThreadCount(int threadCount);

struct ParallelOptions {
    int threadCount = 0;  ///< 0: one a core
    std::size_t chunkSize =
        1;  ///< items a task; fixed, so results cannot depend on the thread count (C10)
};

/// Calls `body(begin, end)` for consecutive chunks of [0, count), in
/// any order and on several threads.
///
/// The first exception of a body stops the rest and is thrown again here.
void parallelFor(std::size_t count, const ParallelOptions& options,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace prt
