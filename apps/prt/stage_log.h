#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "prt/parallel/progress.h"

namespace prt::cli {

class Stopwatch {
  public:
    double seconds() const;

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Tells on stderr how long work is getting on: one line for each stage that is done, and on a
/// terminal a bar with rate and time left for the stage under way.
class StageLog {
  public:
    StageLog();
    ~StageLog();
    StageLog(const StageLog&) = delete;
    StageLog& operator=(const StageLog&) = delete;

    /// Passes the library's progress on to the user, and an interrupt of the user to the library.
    ProgressCallback callback();

    void finishStage(std::string_view stage, double seconds, std::string_view summary);
    void tell(std::string_view sentence);
    void warn(std::string_view sentence);

  private:
    /// Stages of one kind that follow each other, "bounce 1", "bounce 2", …: they share a line.
    struct Series {
        std::string kind;
        std::string unit;
        int stageCount = 0;
        double unitCount = 0.0;
        double seconds = 0.0;
    };

    void show(const Progress& progress);
    void finishSeries();
    void drawBar(const Progress& progress);
    void clearBar();

    bool onTerminal_;
    bool barShown_ = false;
    std::string stage_;
    Stopwatch stageWatch_;
    Series series_;
};

}  // namespace prt::cli
