#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

namespace prt::viewer {

/// How far the reading of a file has come.
struct LoadingStatus {
    enum class Stage { waiting, ready, failed };
    Stage stage = Stage::waiting;
    std::string message{};  ///< why it failed, or what had to be mended; one sentence
};

/// How many are still to be read.
inline std::size_t countWaiting(std::span<const LoadingStatus> statuses) {
    return static_cast<std::size_t>(
        std::ranges::count(statuses, LoadingStatus::Stage::waiting, &LoadingStatus::stage));
}

}  // namespace prt::viewer
