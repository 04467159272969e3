#include "prt/parallel/parallel_for.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "prt/base/assert.h"

#ifdef __SANITIZE_THREAD__
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#endif

namespace prt {
namespace {

/// Calls body(chunk) for each chunk on up to `threadCount` threads.
#ifdef __SANITIZE_THREAD__
// ThreadSanitizer does not see how TBB hands work over, and takes it for races. Plain threads it
// understands.
void runChunks(std::size_t chunkCount, int threadCount,
               const std::function<void(std::size_t)>& body) {
    std::atomic<std::size_t> next{0};
    std::mutex failing;
    std::exception_ptr failure;
    const auto work = [&] {
        try {
            for (std::size_t chunk = next++; chunk < chunkCount; chunk = next++)
                body(chunk);
        } catch (...) {
            const std::lock_guard lock(failing);
            if (!failure) failure = std::current_exception();
            next = chunkCount;
        }
    };
    std::vector<std::jthread> threads;
    for (int i = 0; i < threadCount; ++i)
        threads.emplace_back(work);
    threads.clear();
    if (failure) std::rethrow_exception(failure);
}
#else
void runChunks(std::size_t chunkCount, int threadCount,
               const std::function<void(std::size_t)>& body) {
    // More threads than cores are granted only while a control allows them.
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(threadCount));
    tbb::task_arena arena(threadCount);
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, chunkCount, body); });
}
#endif

}  // namespace

int resolveThreadCount(int threadCount) {
    return threadCount > 0 ? threadCount : tbb::this_task_arena::max_concurrency();
}

void parallelFor(std::size_t count, const ParallelOptions& options,
                 const std::function<void(std::size_t begin, std::size_t end)>& body) {
    PRT_ASSERT(options.chunkSize > 0, "a chunk holds something");
    const std::size_t chunkCount = (count + options.chunkSize - 1) / options.chunkSize;
    runChunks(chunkCount, resolveThreadCount(options.threadCount), [&](std::size_t chunk) {
        const std::size_t begin = chunk * options.chunkSize;
        body(begin, std::min(count, begin + options.chunkSize));
    });
}

}  // namespace prt
