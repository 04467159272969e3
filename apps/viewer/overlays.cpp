#include "apps/viewer/panels.h"

#include <algorithm>

#include <imgui.h>

#include "apps/common/text.h"
#include "apps/viewer/key_bindings.h"

namespace prt::viewer {
namespace {

constexpr ImGuiWindowFlags kTile = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                                   ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_AlwaysAutoResize;
const ImVec4 kFaultColor(0.72f, 0.13f, 0.1f, 1.0f);

float marginPixels() {
    return ImGui::GetFontSize() * 0.8f;
}

/// A tile with a corner at a place of the picture.
///
/// @param width  the most that its text takes, of the picture's
void beginTile(const char* name, const ImVec2& place, const ImVec2& corner, float width = 0.5f) {
    ImGui::SetNextWindowPos(place, ImGuiCond_Always, corner);
    ImGui::Begin(name, nullptr, kTile);
    ImGui::PushTextWrapPos(ImGui::GetIO().DisplaySize.x * width);
}

void endTile() {
    ImGui::PopTextWrapPos();
    ImGui::End();
}

/// What an asset shows where nothing is asked for is all that it has.
cli::ShownTransport shownTransport(const Pane& pane, const Stage& stage) {
    if (pane.transport) return *pane.transport;
    if (!stage.objects().statuses().empty())
        if (const auto asset = stage.objects().asset(0)) return cli::fullestShown(asset->transfer);
    return cli::ShownTransport::unshadowed;
}

std::string describeReference(const ReferencePicture& reference) {
    if (!reference.failure.empty()) return reference.failure;
    if (reference.pathsPerPixel == 0) return "path-traced";
    const auto pathCount = static_cast<std::uint64_t>(reference.pathsPerPixel);
    return "path-traced, " + cli::formatCount(pathCount, "path") + " a pixel";
}

std::string describePane(const Pane& pane, const Stage& stage) {
    if (pane.content == PaneContent::reference) return describeReference(stage.reference());
    if (pane.content == PaneContent::coefficient)
        return "coefficient " + std::to_string(pane.coefficient);
    std::string text(cli::shownTransportName(shownTransport(pane, stage)));
    if (pane.bandCount < kMaxBandCount)
        text += ", " + std::to_string(pane.bandCount) + (pane.bandCount == 1 ? " band" : " bands");
    return text;
}

}  // namespace

void drawMessages(Desk& desk, const Stage& stage) {
    constexpr float kMessageWidth = 0.28f;  // beside the hint
    std::erase_if(desk.toasts,
                  [&](const Toast& toast) { return toast.endSeconds <= desk.seconds; });
    const std::vector<std::string> faults = stage.describeFaults();
    const std::size_t waitingCount =
        countWaiting(stage.objects().statuses()) + countWaiting(stage.lights().statuses());
    if (faults.empty() && waitingCount == 0 && desk.toasts.empty()) return;
    beginTile("messages", {marginPixels(), ImGui::GetIO().DisplaySize.y - marginPixels()},
              {0.0f, 1.0f}, kMessageWidth);
    ImGui::PushStyleColor(ImGuiCol_Text, kFaultColor);
    for (const std::string& fault : faults)
        ImGui::TextWrapped("%s", fault.c_str());
    ImGui::PopStyleColor();
    for (const Toast& toast : desk.toasts)
        ImGui::TextWrapped("%s", toast.text.c_str());
    if (waitingCount > 0) ImGui::TextDisabled("reading, %zu to go", waitingCount);
    endTile();
}

void drawFrameTile(const Desk& desk) {
    if (!desk.showsFrameTimes || desk.isPanelOpen) return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    beginTile("frames", {size.x - marginPixels(), size.y - marginPixels()}, {1.0f, 1.0f});
    drawFrameGraph(desk);
    endTile();
}

void drawHint(const Desk& desk) {
    if (!desk.showsHint) return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    beginTile("hint", {0.5f * size.x, size.y - marginPixels()}, {0.5f, 1.0f}, 1.0f);
    ImGui::TextUnformatted("Drag turns the view, Ctrl + drag the light, the wheel comes nearer.");
    ImGui::TextUnformatted("H tells all keys, Tab opens the panel; drop images and assets here.");
    endTile();
}

void drawHelp(Desk& desk) {
    if (!desk.isHelpOpen) return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::Begin("Mouse and keys", &desk.isHelpOpen,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const KeyHelp& line : keyHelp()) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(line.keys);
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", line.what);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

void drawSplitLine(const ViewState& view, const Stage& stage) {
    if (!view.right) return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float x = size.x * static_cast<float>(view.splitPosition);
    const float font = ImGui::GetFontSize();
    ImDrawList* drawing = ImGui::GetBackgroundDrawList();
    drawing->AddLine({x, 0.0f}, {x, size.y}, IM_COL32(0, 0, 0, 110), 0.25f * font);
    drawing->AddLine({x, 0.0f}, {x, size.y}, IM_COL32_WHITE, 0.1f * font);
    drawing->AddCircleFilled({x, 0.5f * size.y}, 0.5f * font, IM_COL32_WHITE);
    drawing->AddCircle({x, 0.5f * size.y}, 0.5f * font, IM_COL32(0, 0, 0, 110), 0, 0.1f * font);
    beginTile("left half", {x - marginPixels(), marginPixels()}, {1.0f, 0.0f});
    ImGui::TextUnformatted(describePane(view.left, stage).c_str());
    endTile();
    beginTile("right half", {x + marginPixels(), marginPixels()}, {0.0f, 0.0f});
    ImGui::TextUnformatted(describePane(*view.right, stage).c_str());
    endTile();
}

}  // namespace prt::viewer
