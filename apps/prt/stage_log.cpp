#include "apps/prt/stage_log.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "apps/common/text.h"
#include "apps/prt/interrupts.h"

namespace prt::cli {
namespace {

/// A log that cannot be written, because the terminal has gone, must not stop the work.
void say(const std::string& text) {
    std::fputs(text.c_str(), stderr);
}

void printStage(std::string_view stage, double seconds, std::string_view summary) {
    say(fmt::format("{:<10} {:>8.2f} s  {}\n", stage, seconds, summary));
}

}  // namespace

double Stopwatch::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

StageLog::StageLog() : onTerminal_(::isatty(STDERR_FILENO) != 0) {}

StageLog::~StageLog() {
    clearBar();
}

ProgressCallback StageLog::callback() {
    return [this](const Progress& progress) {
        show(progress);
        return !interruptRequested();
    };
}

void StageLog::finishStage(std::string_view stage, double seconds, std::string_view summary) {
    finishSeries();
    clearBar();
    printStage(stage, seconds, summary);
}

void StageLog::tell(std::string_view sentence) {
    finishSeries();
    clearBar();
    say(fmt::format("prt: {}\n", sentence));
}

void StageLog::warn(std::string_view sentence) {
    clearBar();
    say(fmt::format("prt: warning: {}\n", sentence));
}

void StageLog::show(const Progress& progress) {
    if (progress.total == 0) return;
    if (progress.stage != stage_) {
        stage_ = progress.stage;
        stageWatch_ = Stopwatch();
        const std::string kind = stage_.substr(0, stage_.find(' '));
        if (kind != series_.kind) {
            finishSeries();
            series_ = {.kind = kind, .unit = std::string(progress.unit)};
        }
    }
    if (progress.done < progress.total) {
        if (onTerminal_) drawBar(progress);
        return;
    }
    ++series_.stageCount;
    series_.unitCount += static_cast<double>(progress.total);
    series_.seconds += stageWatch_.seconds();
    stage_.clear();
}

void StageLog::finishSeries() {
    const Series series = std::exchange(series_, {});
    if (series.stageCount == 0) return;
    clearBar();
    const std::string times = series.stageCount > 1 ? fmt::format("{} × ", series.stageCount) : "";
    const double rate = series.unitCount / std::max(series.seconds, 1e-6);
    printStage(series.kind, series.seconds,
               times + formatQuantity(series.unitCount / series.stageCount, series.unit) + ", " +
                   formatQuantity(rate, series.unit + "/s"));
}

void StageLog::drawBar(const Progress& progress) {
    constexpr int kBarWidth = 28;
    const double fraction =
        static_cast<double>(progress.done) / static_cast<double>(progress.total);
    const int filled = static_cast<int>(fraction * kBarWidth);
    std::string line = fmt::format("{:<10} [{:=<{}}{:<{}}] {:3.0f} %", progress.stage, "", filled,
                                   "", kBarWidth - filled, 100.0 * fraction);
    const double seconds = stageWatch_.seconds();
    if (progress.done > 0 && seconds > 0.0) {
        const double rate = static_cast<double>(progress.done) / seconds;
        const double secondsLeft = static_cast<double>(progress.total - progress.done) / rate;
        line +=
            fmt::format("  {}  {} left", formatQuantity(rate, std::string(progress.unit) + "/s"),
                        formatDuration(secondsLeft));
    }
    say(fmt::format("\r{}\x1b[K", line));
    barShown_ = true;
}

void StageLog::clearBar() {
    if (barShown_) say("\r\x1b[K");
    barShown_ = false;
}

}  // namespace prt::cli
