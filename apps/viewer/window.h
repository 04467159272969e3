#pragma once

#include <string>
#include <vector>

#include "apps/viewer/stage.h"
#include "apps/viewer/view_file.h"

namespace prt::viewer {

struct WindowOptions {
    int width = 1280;
    int height = 720;
    bool isPanelOpen = false;  ///< from the beginning
    StageOptions stage{};
    /// Done one after the other once all is read, then the window closes; none: a person uses it.
    std::vector<ScriptStep> script{};
};

/// Shows a view in a window until it is closed. A screenshot of the script is of the whole window,
/// panels included.
///
/// @return        the view as it was left
/// @throws Error  unsupported without a display or OpenGL 4.3; as the script's files
ViewState runWindow(const ViewState& view, const WindowOptions& options);

/// Draws a view in a window whose light turns, as fast as it can.
///
/// @return        as reportFrames
/// @throws Error  as runWindow; malformed if nothing can be shown
std::string benchmarkWindow(const ViewState& view, int frameCount, const WindowOptions& options);

}  // namespace prt::viewer
