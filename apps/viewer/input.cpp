#include "apps/viewer/input.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/common/parse.h"

namespace prt::viewer {
namespace {

constexpr double kDegreesPerHeight = 180.0;
constexpr double kLookDegreesPerHeight = 60.0;
constexpr double kRadians = std::numbers::pi / 180.0;

/// What is turned keeps up with the mouse on the side that faces the eye.
Vec3d turn(const Vec3d& degrees, const MouseStep& step, const CameraPose& pose) {
    const double azimuth = pose.azimuthDegrees * kRadians;
    const Vec3d right(std::cos(azimuth), 0.0, -std::sin(azimuth));
    const double sideways = step.rightward * kDegreesPerHeight * kRadians;
    const double over = step.downward * kDegreesPerHeight * kRadians;
    return cli::degreesFromRotation(rotationY(sideways) * rotationAbout(right, over) *
                                    cli::rotationFromDegrees(degrees));
}

}  // namespace

Drag chooseDrag(MouseButton button, const Modifiers& modifiers, bool isOnSplit) {
    if (button == MouseButton::middle) return Drag::pan;
    if (button == MouseButton::right) return Drag::lookAround;
    if (modifiers.control && modifiers.shift) return Drag::turnObject;
    if (modifiers.control || modifiers.alt) return Drag::turnLight;
    if (modifiers.shift) return Drag::pan;
    return isOnSplit ? Drag::moveSplit : Drag::orbit;
}

void applyDrag(ViewState& view, Drag drag, const MouseStep& step, const CameraPose& pose,
               double aspectRatio, std::size_t object) {
    switch (drag) {
        case Drag::orbit:
            view.camera =
                orbit(pose, -step.rightward * kDegreesPerHeight, step.downward * kDegreesPerHeight);
            return;
        case Drag::pan:
            view.camera = pan(pose, -step.rightward, step.downward);
            return;
        case Drag::lookAround:
            view.camera = lookAround(pose, -step.rightward * kLookDegreesPerHeight,
                                     step.downward * kLookDegreesPerHeight);
            return;
        case Drag::turnLight:
            view.lightRotationDegrees = turn(view.lightRotationDegrees, step, pose);
            return;
        case Drag::turnObject:
            if (object >= view.objects.size()) return;
            view.objects[object].rotationDegrees =
                turn(view.objects[object].rotationDegrees, step, pose);
            return;
        case Drag::moveSplit:
            view.splitPosition =
                std::clamp(view.splitPosition + step.rightward / aspectRatio, 0.0, 1.0);
            return;
    }
}

void applyWheel(ViewState& view, double notches, const CameraPose& pose) {
    constexpr double kFactorPerNotch = 0.9;
    view.camera = zoom(pose, std::pow(kFactorPerNotch, notches));
}

void applyFlight(ViewState& view, const Flight& flight, double seconds, bool isFast,
                 const CameraPose& pose) {
    if (flight == Flight{}) return;
    constexpr double kDistancesPerSecond = 0.5;
    const double step = seconds * kDistancesPerSecond * (isFast ? 4.0 : 1.0);
    view.camera = fly(pose, step * flight.forward, step * flight.rightward, step * flight.upward);
}

bool isOnSplit(const ViewState& view, double x, double margin) {
    return view.right && std::abs(x - view.splitPosition) <= margin;
}

Pane& paneAt(ViewState& view, double x) {
    return view.right && x >= view.splitPosition ? *view.right : view.left;
}

}  // namespace prt::viewer
