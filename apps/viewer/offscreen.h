#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/viewer/stage.h"
#include "apps/viewer/view_file.h"

namespace prt::viewer {

/// How a stage draws without a window.
struct OffscreenOptions {
    int width = 1280;
    int height = 720;
    /// A pixel; none: as the window has them, at rest or moving.
    std::optional<int> sampleCount{};
    StageOptions stage{.awaitedPathsPerPixel = 64};
};

/// Writes the picture of a view: .exr as linear radiance without lobes, .png as the window shows
/// it, without panels.
///
/// @throws Error  writeFailed
void writeScreenshot(Stage& stage, const ViewState& view, const OffscreenOptions& options,
                     const std::string& path);

/// Does the steps of a script one after the other, as the window does.
///
/// @return        what could not be shown, one sentence each
/// @throws Error  unsupported without OpenGL 4.3; malformed if nothing can be shown at all; as
///                applyPatch and writeScreenshot
std::vector<std::string> runOffscreen(const ViewState& view, const std::vector<ScriptStep>& script,
                                      const OffscreenOptions& options);

}  // namespace prt::viewer
