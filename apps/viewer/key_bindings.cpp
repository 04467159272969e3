#include "apps/viewer/key_bindings.h"

#include <algorithm>
#include <array>
#include <string_view>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "apps/common/ringing.h"

namespace prt::viewer {
namespace {

constexpr std::array kHelp = std::to_array<KeyHelp>({
    {"drag", "turn around the object"},
    {"Ctrl or Alt + drag", "turn the light"},
    {"Ctrl + Shift + drag", "turn the object under the mouse"},
    {"Shift or middle + drag", "move the picture"},
    {"right + drag", "look around"},
    {"wheel", "nearer or farther"},
    {"W A S D, E Q", "fly, up and down; Shift is faster"},
    {"click", "the transfer of a vertex as a lobe; K hides it, Esc forgets it"},
    {"F", "frame all objects"},
    {"1 ... 9, 0", "use so many bands of the light, 0 for ten"},
    {"T, Shift + T", "next, previous transport: unshadowed, shadowed ..."},
    {"C", "a coefficient of the transfer as false colour"},
    {"left, right", "previous, next coefficient"},
    {"V", "split the picture; drag its line"},
    {"R", "path-traced reference in the right half"},
    {"N", "next window against ringing"},
    {"L", "the light as a lobe"},
    {"B", "background"},
    {"M", "mesh as wire frame"},
    {"+ and -, X", "exposure by half stops, automatic exposure"},
    {"Y", "next tone curve"},
    {"Tab", "panel"},
    {"G", "times of frames"},
    {"P or F12", "screenshot as PNG and EXR"},
    {"Ctrl + S, Ctrl + O", "save the view, load it"},
    {"H or F1", "this help"},
    {"Ctrl + Q", "close"},
});

/// What keys work on.
struct Work {
    ViewState& view;
    Desk& desk;
    Pane& pane;
    const Choices& choices;
};

/// The choice that stands so far behind one, around the end; the first where it is not among them.
template <class Values, class Value>
Value step(const Values& values, const Value& value, bool isBackward) {
    const auto count = std::size(values);
    const auto found = std::find(std::begin(values), std::end(values), value);
    if (found == std::end(values)) return values[0];
    const auto index = static_cast<std::size_t>(found - std::begin(values));
    return values[(index + (isBackward ? count - 1 : 1)) % count];
}

void stepTransport(const Work& work, bool isBackward) {
    if (work.choices.transports.empty()) return;
    const auto& all = work.choices.transports;
    // What is shown without a choice is the fullest, which is the last.
    work.pane.transport = step(all, work.pane.transport.value_or(all.back()), isBackward);
    work.pane.content = PaneContent::relit;
}

void stepCoefficient(const Work& work, int by) {
    const int count = shCoefficientCount(work.choices.bandCount);
    work.pane.content = PaneContent::coefficient;
    work.pane.coefficient = (work.pane.coefficient + by + count) % count;
}

void toggleCoefficient(const Work& work) {
    const bool isShown = work.pane.content == PaneContent::coefficient;
    work.pane.content = isShown ? PaneContent::relit : PaneContent::coefficient;
}

/// The other half shows less, so that there is something to compare.
void toggleSplit(const Work& work) {
    if (work.view.right) {
        work.view.right.reset();
        return;
    }
    work.view.right = work.view.left;
    if (!work.choices.transports.empty()) work.view.right->transport = work.choices.transports[0];
}

void toggleReference(const Work& work) {
    const bool isShown = work.view.right && work.view.right->content == PaneContent::reference;
    work.view.right = isShown ? std::nullopt : std::optional<Pane>(work.view.left);
    if (work.view.right) work.view.right->content = PaneContent::reference;
}

void stepWindow(const Work& work) {
    work.view.window = step(cli::kWindowNames, std::string_view(work.view.window), false);
    work.desk.tell("window: " + work.view.window);
}

void stepToneCurve(const Work& work) {
    constexpr std::array kCurves = {ToneCurve::none, ToneCurve::aces, ToneCurve::neutral};
    work.view.display.toneCurve = step(kCurves, work.view.display.toneCurve, false);
}

bool applyDigit(const Work& work, int key) {
    if (key < '0' || key > '9') return false;
    work.pane.bandCount = key == '0' ? 10 : key - '0';
    if (work.pane.content == PaneContent::coefficient) work.pane.content = PaneContent::relit;
    return true;
}

void applyControlKey(Desk& desk, int key) {
    switch (key) {
        case 'S':
            desk.wantsSave = true;
            return;
        case 'O':
            desk.wantsLoad = true;
            return;
        case 'Q':
            desk.wantsClose = true;
            return;
        default:
            return;
    }
}

/// What the desk is for, rather than the view. @return whether the key was for that
bool applyDeskKey(ViewState& view, Desk& desk, int key) {
    switch (key) {
        case GLFW_KEY_TAB:
            desk.isPanelOpen = !desk.isPanelOpen;
            return true;
        case 'H':
        case GLFW_KEY_F1:
            desk.isHelpOpen = !desk.isHelpOpen;
            return true;
        case 'G':
            desk.showsFrameTimes = !desk.showsFrameTimes;
            return true;
        case 'P':
        case GLFW_KEY_F12:
            desk.wantsScreenshot = true;
            return true;
        case GLFW_KEY_ESCAPE:
            if (!std::exchange(desk.isHelpOpen, false)) view.picked.reset();
            return true;
        default:
            return false;
    }
}

bool applyViewKey(ViewState& view, int key) {
    constexpr float kStopsPerPress = 0.5f;
    switch (key) {
        case 'F':
            view.camera.reset();
            return true;
        case 'L':
            view.showLightLobe = !view.showLightLobe;
            return true;
        case 'K':
            view.showTransferLobe = !view.showTransferLobe;
            return true;
        case 'B':
            view.showBackground = !view.showBackground;
            return true;
        case 'M':
            view.wireFrame = !view.wireFrame;
            return true;
        case 'X':
            view.autoExposure = !view.autoExposure;
            return true;
        case GLFW_KEY_EQUAL:
        case GLFW_KEY_KP_ADD:
            view.display.exposureStops += kStopsPerPress;
            return true;
        case GLFW_KEY_MINUS:
        case GLFW_KEY_KP_SUBTRACT:
            view.display.exposureStops -= kStopsPerPress;
            return true;
        default:
            return false;
    }
}

void applyPaneKey(const Work& work, const KeyPress& press) {
    switch (press.key) {
        case 'T':
            stepTransport(work, press.shift);
            return;
        case 'C':
            toggleCoefficient(work);
            return;
        case GLFW_KEY_LEFT:
            stepCoefficient(work, -1);
            return;
        case GLFW_KEY_RIGHT:
            stepCoefficient(work, 1);
            return;
        case 'V':
            toggleSplit(work);
            return;
        case 'R':
            toggleReference(work);
            return;
        case 'N':
            stepWindow(work);
            return;
        case 'Y':
            stepToneCurve(work);
            return;
        default:
            return;
    }
}

}  // namespace

std::span<const KeyHelp> keyHelp() {
    return kHelp;
}

void applyKey(ViewState& view, Desk& desk, const KeyPress& press, Pane& pane,
              const Choices& choices) {
    const Work work{view, desk, pane, choices};
    if (press.control)
        applyControlKey(desk, press.key);
    else if (!applyDeskKey(view, desk, press.key) && !applyViewKey(view, press.key) &&
             !applyDigit(work, press.key))
        applyPaneKey(work, press);
}

}  // namespace prt::viewer
