#include "prt/parallel/progress.h"

#include "prt/base/error.h"

namespace prt {
namespace {

constexpr std::chrono::milliseconds kReportInterval{100};

}  // namespace

ProgressReporter::ProgressReporter(const ProgressCallback& callback, std::string_view stage,
                                   std::string_view unit, std::uint64_t total)
    : callback_(callback), stage_(stage), unit_(unit), total_(total), lastReport_(Clock::now()) {
    report(0);
}

void ProgressReporter::advance(std::uint64_t units) {
    const std::uint64_t done = done_.fetch_add(units) + units;
    if (cancelled_) throw Error(ErrorCode::cancelled, "cancelled");
    if (!callback_) return;

    // Whoever finds another thread reporting goes on with its work; only
    // the last unit waits for its turn.
    std::unique_lock lock(reporting_, std::defer_lock);
    if (done == total_) {
        lock.lock();
    } else if (!lock.try_lock() || Clock::now() - lastReport_ < kReportInterval) {
        return;
    }
    report(done);
}

void ProgressReporter::report(std::uint64_t done) {
    if (!callback_) return;
    lastReport_ = Clock::now();
    if (callback_({stage_, unit_, done, total_})) return;
    cancelled_ = true;
    throw Error(ErrorCode::cancelled, "cancelled");
}

}  // namespace prt
