#include "apps/viewer/pointer.h"

#include <array>
#include <cmath>

#include <imgui.h>

namespace prt::viewer {
namespace {

constexpr double kSplitMarginPixels = 6.0;

/// A button that went down and up within so much of the height has been clicked.
constexpr double kClickTravel = 0.006;

struct ButtonName {
    MouseButton button;
    ImGuiMouseButton imgui;
};
constexpr std::array<ButtonName, 3> kButtons = {{{MouseButton::left, ImGuiMouseButton_Left},
                                                 {MouseButton::middle, ImGuiMouseButton_Middle},
                                                 {MouseButton::right, ImGuiMouseButton_Right}}};

ImGuiMouseButton imguiButton(MouseButton button) {
    return kButtons[static_cast<std::size_t>(button)].imgui;
}

bool isMouseOnSplit(const ViewState& view) {
    const double width = static_cast<double>(ImGui::GetIO().DisplaySize.x);
    return isOnSplit(view, mousePoint().x, kSplitMarginPixels / width);
}

double aspectRatio() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    return static_cast<double>(size.x) / static_cast<double>(size.y);
}

void beginDrag(const ViewState& view, Desk& desk, const Stage& stage, Picker& picker) {
    const ImGuiIO& io = ImGui::GetIO();
    const Modifiers modifiers{.shift = io.KeyShift, .control = io.KeyCtrl, .alt = io.KeyAlt};
    for (const auto& [button, imgui] : kButtons)
        if (ImGui::IsMouseClicked(imgui))
            desk.held = HeldButton{.button = button,
                                   .drag = chooseDrag(button, modifiers, isMouseOnSplit(view))};
    if (!desk.held || desk.held->drag != Drag::turnObject) return;
    if (const auto picked = picker.pick(stage, view, mousePoint(), aspectRatio()))
        desk.selectedObject = picked->object;
}

/// @return whether the mouse has clicked, rather than dragged
bool continueDrag(ViewState& view, Desk& desk, const CameraPose& pose) {
    const ImGuiIO& io = ImGui::GetIO();
    const auto height = static_cast<double>(io.DisplaySize.y);
    const MouseStep step{static_cast<double>(io.MouseDelta.x) / height,
                         static_cast<double>(io.MouseDelta.y) / height};
    HeldButton& held = *desk.held;
    held.travel += std::hypot(step.rightward, step.downward);
    const bool isClick = held.travel <= kClickTravel;
    if (!isClick) {
        applyDrag(view, held.drag, step, pose, aspectRatio(), desk.selectedObject);
        desk.showsHint = false;
    }
    if (ImGui::IsMouseDown(imguiButton(held.button))) return false;
    const bool isPlainClick = isClick && held.drag == Drag::orbit;
    desk.held.reset();
    return isPlainClick;
}

}  // namespace

PicturePoint mousePoint() {
    const ImGuiIO& io = ImGui::GetIO();
    return {static_cast<double>(io.MousePos.x / io.DisplaySize.x),
            static_cast<double>(io.MousePos.y / io.DisplaySize.y)};
}

void followMouse(ViewState& view, Desk& desk, const Stage& stage, Picker& picker) {
    const ImGuiIO& io = ImGui::GetIO();
    const CameraPose pose = stage.cameraPose(view, aspectRatio());
    if (!io.WantCaptureMouse && !desk.held) {
        if (io.MouseWheel != 0.0f) applyWheel(view, static_cast<double>(io.MouseWheel), pose);
        beginDrag(view, desk, stage, picker);  // the way to there is not part of it
    } else if (desk.held && continueDrag(view, desk, pose)) {
        view.picked = picker.pick(stage, view, mousePoint(), aspectRatio());
    }
    const bool movesSplit = desk.held ? desk.held->drag == Drag::moveSplit
                                      : !io.WantCaptureMouse && isMouseOnSplit(view);
    if (movesSplit) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
}

}  // namespace prt::viewer
