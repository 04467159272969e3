#pragma once

#include <span>

#include "apps/viewer/desk.h"
#include "apps/viewer/glfw_window.h"
#include "apps/viewer/view_state.h"

namespace prt::viewer {

/// A line of the help.
struct KeyHelp {
    const char* keys;
    const char* what;
};

/// All that mouse and keys do.
std::span<const KeyHelp> keyHelp();

/// Does what a key is for; nothing for a key that is for nothing.
///
/// @param pane  of the view: what keys of one pane change
void applyKey(ViewState& view, Desk& desk, const KeyPress& press, Pane& pane,
              const Choices& choices);

/// Where the keys that fly are held. @param isHeld  of keys as KeyPress numbers them
template <class IsHeld>
Flight findFlight(const IsHeld& isHeld) {
    const auto axis = [&](int more, int less) { return int{isHeld(more)} - int{isHeld(less)}; };
    return {.forward = axis('W', 'S'), .rightward = axis('D', 'A'), .upward = axis('E', 'Q')};
}

}  // namespace prt::viewer
