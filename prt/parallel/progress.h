#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string_view>

namespace prt {

/// How far one stage of long work has come.
struct Progress {
    std::string_view stage;  ///< "trace", "bounce", …
    std::string_view unit;   ///< what is counted: "rays", "receivers"
    std::uint64_t done = 0;
    std::uint64_t total = 0;
};

/// Called now and then, by one thread at a time. Returning false cancels the work, which then
/// throws Error{cancelled}. May be empty.
using ProgressCallback = std::function<bool(const Progress&)>;

/// Collects progress from many threads and passes it on, at the start, at the end,
/// and ten times a second between.
class ProgressReporter {
  public:
    /// @param callback, stage, unit  must outlive the reporter
    ProgressReporter(const ProgressCallback& callback, std::string_view stage,
                     std::string_view unit, std::uint64_t total);
    ProgressReporter(const ProgressReporter&) = delete;
    ProgressReporter& operator=(const ProgressReporter&) = delete;

    /// Adds finished units. @throws Error cancelled, as soon as the callback has returned false
    void advance(std::uint64_t units);

  private:
    using Clock = std::chrono::steady_clock;

    void report(std::uint64_t done);

    const ProgressCallback& callback_;
    std::string_view stage_;
    std::string_view unit_;
    std::uint64_t total_;
    std::atomic<std::uint64_t> done_{0};
    std::atomic<bool> cancelled_{false};
    std::mutex reporting_;
    Clock::time_point lastReport_;
};

}  // namespace prt
