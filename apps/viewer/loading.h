#pragma once

#include <string>

namespace prt::viewer {

/// How far the reading of a file has come.
struct LoadingStatus {
    enum class Stage { waiting, ready, failed };
    Stage stage = Stage::waiting;
    std::string message{};  ///< why it failed, or what had to be mended; one sentence
};

}  // namespace prt::viewer
