#pragma once

#include "apps/viewer/desk.h"
#include "apps/viewer/picker.h"
#include "apps/viewer/stage.h"
#include "apps/viewer/view_state.h"

namespace prt::viewer {

/// Does what the mouse does outside of panels, as Dear ImGui has seen it.
void followMouse(ViewState& view, Desk& desk, const Stage& stage, Picker& picker);

/// Where the mouse is.
PicturePoint mousePoint();

}  // namespace prt::viewer
