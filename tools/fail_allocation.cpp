// Preloaded into a program, refuses its allocation number FAIL_AT after the start of main, and then
// all of at least FAIL_BYTES. At the end of main it writes to standard error how many there were.
// See tools/fail_allocations.

#include <dlfcn.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

using Main = int (*)(int, char**, char**);
using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);

std::atomic<long> allocationCount{0};
std::atomic<bool> mainRuns{false};
long refusedNumber = 0;
std::size_t refusedBytes = SIZE_MAX;
Main wrappedMain = nullptr;

bool isRefused(std::size_t bytes) {
    if (!mainRuns) return false;
    const long number = ++allocationCount;
    if (refusedNumber == 0 || number < refusedNumber) return false;
    if (number > refusedNumber && bytes < refusedBytes) return false;
    errno = ENOMEM;
    return true;
}

int countedMain(int argumentCount, char** arguments, char** environment) {
    if (const char* const number = std::getenv("FAIL_AT")) refusedNumber = std::atol(number);
    if (const char* const bytes = std::getenv("FAIL_BYTES"))
        refusedBytes = std::strtoull(bytes, nullptr, 10);
    mainRuns = true;
    const int exitCode = wrappedMain(argumentCount, arguments, environment);
    mainRuns = false;
    std::fprintf(stderr, "allocations: %ld\n", allocationCount.load());
    return exitCode;
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
    return isRefused(size) ? nullptr : __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
    return isRefused(count * size) ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* memory, std::size_t size) {
    return isRefused(size) ? nullptr : __libc_realloc(memory, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
    return isRefused(size) ? nullptr : __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
    return memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
    *memory = memalign(alignment, size);
    return *memory ? 0 : ENOMEM;
}

int __libc_start_main(Main entry, int argumentCount, char** arguments, void (*begin)(),
                      void (*end)(), void (*unload)(), void* stackEnd) {
    wrappedMain = entry;
    const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
    return start(countedMain, argumentCount, arguments, begin, end, unload, stackEnd);
}

}  // extern "C"
