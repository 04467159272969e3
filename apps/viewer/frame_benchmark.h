#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/viewer/offscreen.h"

namespace prt::viewer {

/// Times frames of a view whose light turns.
///
/// @param frameCount  after a few more, which are not counted
/// @param draw        draws a frame, all of it
/// @return            milliseconds, one a frame
std::vector<double> timeFrames(ViewState view, int frameCount,
                               const std::function<void(const ViewState&)>& draw);

/// What frames were drawn to.
struct FrameSetting {
    std::string renderer{};
    bool inWindow = false;
    int width = 0;
    int height = 0;
    int sampleCount = 0;  ///< a pixel
};

/// JSON: what was drawn on what, and percentiles of a frame's milliseconds.
std::string reportFrames(const Stage& stage, const FrameSetting& setting,
                         const std::vector<double>& milliseconds);

/// Both without a window: each frame is relit, drawn, and made ready for a screen.
///
/// @throws Error  as runOffscreen
std::string benchmarkOffscreen(const ViewState& view, int frameCount,
                               const OffscreenOptions& options);

}  // namespace prt::viewer
