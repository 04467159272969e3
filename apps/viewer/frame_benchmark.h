#pragma once

#include <string>

#include "apps/viewer/offscreen.h"

namespace prt::viewer {

/// Times frames of a view whose light turns: relit, drawn and made ready for the screen.
///
/// @param frameCount  after as many again as a tenth of them, which are not counted
/// @return            JSON: what was drawn on what, and percentiles of a frame's milliseconds
/// @throws Error      as runOffscreen
std::string benchmarkFrames(const ViewState& view, int frameCount, const OffscreenOptions& options);

}  // namespace prt::viewer
