#pragma once

#include <cstddef>
#include <optional>

#include "apps/viewer/view_state.h"

namespace prt::viewer {

enum class MouseButton { left, middle, right };

/// Keys that are held while something else happens.
struct Modifiers {
    bool shift = false;
    bool control = false;
    bool alt = false;
};

/// What moving the mouse with a button held does.
enum class Drag {
    orbit,
    pan,
    lookAround,
    turnLight,
    turnObject,
    moveSplit,
};

/// @param isOnSplit  whether the button went down on the line that splits the picture
Drag chooseDrag(MouseButton button, const Modifiers& modifiers, bool isOnSplit);

/// How far the mouse went, in heights of the picture.
struct MouseStep {
    double rightward = 0.0;
    double downward = 0.0;
};

/// Does a step of a drag to a view. The camera, the light or the object turns half around in a
/// picture's height, and what is near the eye follows the mouse.
///
/// @param pose    of the camera now
/// @param object  that turns; none where the view has no such object
/// @param aspectRatio  width over height of the picture
void applyDrag(ViewState& view, Drag drag, const MouseStep& step, const CameraPose& pose,
               double aspectRatio, std::size_t object);

/// @param notches  of the wheel, positive to come nearer
void applyWheel(ViewState& view, double notches, const CameraPose& pose);

/// Directions of flight whose keys are held.
struct Flight {
    int forward = 0;  ///< −1, 0 or 1
    int rightward = 0;
    int upward = 0;
    bool operator==(const Flight&) const = default;
};

/// Flies for a while. @param isFast  four times as fast
void applyFlight(ViewState& view, const Flight& flight, double seconds, bool isFast,
                 const CameraPose& pose);

/// Whether a place is on the line that splits the picture. @param x, margin  of its width
bool isOnSplit(const ViewState& view, double x, double margin);

/// The pane of a place. @param x  0 … 1 of the picture's width
Pane& paneAt(ViewState& view, double x);

}  // namespace prt::viewer
