#include "apps/prt/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <new>
#include <string>

namespace prt::cli {
namespace {

/// The limit of a control group, which may say "max" for none.
std::uint64_t readGroupLimit(const std::string& folder) {
    std::uint64_t bytes = 0;
    std::ifstream(folder + "/memory.max") >> bytes;
    return bytes > 0 ? bytes : UINT64_MAX;
}

/// Of the group this process is in, and of those around it.
std::uint64_t groupLimit() {
    const std::string root = "/sys/fs/cgroup";
    std::string line;
    std::ifstream groups("/proc/self/cgroup");
    while (std::getline(groups, line) && !line.starts_with("0::")) {
    }
    std::uint64_t limit = readGroupLimit(root);
    if (!line.starts_with("0::/")) return limit;
    for (std::string group = line.substr(3); group.size() > 1; group.resize(group.rfind('/')))
        limit = std::min(limit, readGroupLimit(root + group));
    return limit;
}

}  // namespace

std::uint64_t peakBytes() {
    rusage usage = {};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::uint64_t grantedBytes() {
    rlimit addressSpace = {};
    ::getrlimit(RLIMIT_AS, &addressSpace);
    const std::uint64_t machine = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                                  static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    return std::min({machine, static_cast<std::uint64_t>(addressSpace.rlim_cur), groupLimit()});
}

void reserveMemoryForTheEnd() {
    constexpr std::size_t kReservedBytes = std::size_t(1) << 20;
    static std::atomic<void*> reserve = std::malloc(kReservedBytes);
    std::set_new_handler([] {
        void* const kept = reserve.exchange(nullptr);
        if (!kept) throw std::bad_alloc();
        std::free(kept);
    });
}

}  // namespace prt::cli
