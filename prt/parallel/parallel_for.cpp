#include "prt/parallel/parallel_for.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "prt/base/assert.h"

namespace prt {

int resolveThreadCount(int threadCount) {
    return threadCount > 0 ? threadCount : tbb::this_task_arena::max_concurrency();
}

void parallelFor(std::size_t count, const ParallelOptions& options,
                 const std::function<void(std::size_t begin, std::size_t end)>& body) {
    PRT_ASSERT(options.chunkSize > 0, "a chunk holds something");
    const std::size_t chunkCount = (count + options.chunkSize - 1) / options.chunkSize;
    const int threadCount = resolveThreadCount(options.threadCount);
    // More threads than cores are granted only while a control allows them.
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(threadCount));
    tbb::task_arena arena(threadCount);
    arena.execute([&] {
        tbb::parallel_for(std::size_t{0}, chunkCount, [&](std::size_t chunk) {
            const std::size_t begin = chunk * options.chunkSize;
            body(begin, std::min(count, begin + options.chunkSize));
        });
    });
}

}  // namespace prt
