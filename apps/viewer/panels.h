#pragma once

#include "apps/viewer/desk.h"
#include "apps/viewer/light_folder.h"
#include "apps/viewer/stage.h"
#include "apps/viewer/view_state.h"

namespace prt::viewer {

// What lies over the picture. Each is laid out in a frame of Dear ImGui, and changes view and desk
// as a person tells it.

/// The side panel with its sections, or the button that opens it.
void drawPanel(ViewState& view, Desk& desk, const Stage& stage, LightFolder& folder);

// Sections of the panel.
void drawLightSection(ViewState& view, Desk& desk, const Stage& stage, LightFolder& folder);
void drawPictureSection(ViewState& view, Desk& desk, const Stage& stage);
void drawObjectSection(ViewState& view, Desk& desk, const Stage& stage);
void drawFigureSection(const Desk& desk);

/// The energy of each band of the light, and its coefficients.
void drawLightBars(const ViewState& view, const Stage& stage);

/// The time of the last frames, with percentiles: in the panel, and in a corner where the panel is
/// closed.
void drawFrameGraph(const Desk& desk);
void drawFrameTile(const Desk& desk);

/// What could not be read or shown, what is being read, and what has just been done, in a corner.
void drawMessages(Desk& desk, const Stage& stage);
/// Two lines for somebody who has not done anything yet.
void drawHint(const Desk& desk);
/// All that mouse and keys do.
void drawHelp(Desk& desk);
/// The line that splits the picture, and what stands left and right of it.
void drawSplitLine(const ViewState& view, const Stage& stage);

}  // namespace prt::viewer
