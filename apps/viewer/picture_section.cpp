#include "apps/viewer/panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "apps/common/ringing.h"

namespace prt::viewer {
namespace {

const char* transportName(const std::optional<cli::ShownTransport>& transport) {
    return transport ? cli::shownTransportName(*transport).data() : "fullest";
}

void drawTransport(Pane& pane, const Choices& choices) {
    if (!ImGui::BeginCombo("transport", transportName(pane.transport))) return;
    if (ImGui::Selectable("fullest", !pane.transport)) pane.transport.reset();
    for (const cli::ShownTransport transport : choices.transports)
        if (ImGui::Selectable(transportName(transport), pane.transport == transport))
            pane.transport = transport;
    ImGui::EndCombo();
}

void drawCoefficient(Pane& pane, const Choices& choices) {
    const int last = shCoefficientCount(choices.bandCount) - 1;
    pane.coefficient = std::clamp(pane.coefficient, 0, last);
    ImGui::SliderInt("coefficient", &pane.coefficient, 0, last, "%d", ImGuiSliderFlags_AlwaysClamp);
    const int degree = static_cast<int>(std::sqrt(pane.coefficient));
    ImGui::TextDisabled("l = %d, m = %d", degree, pane.coefficient - degree * (degree + 1));
}

void drawPane(const char* title, Pane& pane, const Choices& choices) {
    static constexpr std::array<const char*, 3> kContents = {"relit", "a coefficient",
                                                             "path-traced"};
    ImGui::PushID(title);
    int content = static_cast<int>(pane.content);
    if (ImGui::Combo(title, &content, kContents.data(), static_cast<int>(kContents.size())))
        pane.content = static_cast<PaneContent>(content);
    if (pane.content == PaneContent::coefficient) drawCoefficient(pane, choices);
    if (pane.content != PaneContent::reference) drawTransport(pane, choices);
    if (pane.content == PaneContent::relit) {
        int bandCount = std::min(pane.bandCount, choices.bandCount);
        if (ImGui::SliderInt("bands", &bandCount, 1, choices.bandCount, "%d",
                             ImGuiSliderFlags_AlwaysClamp))
            pane.bandCount = bandCount;
    }
    ImGui::PopID();
}

void drawSplit(ViewState& view) {
    bool isSplit = view.right.has_value();
    if (!ImGui::Checkbox("split in two", &isSplit)) return;
    if (isSplit)
        view.right = view.left;
    else
        view.right.reset();
}

void drawWindow(ViewState& view) {
    if (!ImGui::BeginCombo("window", view.window.c_str())) return;
    for (const std::string_view window : cli::kWindowNames)
        if (ImGui::Selectable(window.data(), view.window == window)) view.window = window;
    ImGui::EndCombo();
}

void drawDisplay(ViewState& view) {
    static constexpr std::array<const char*, 3> kCurves = {"none", "ACES", "neutral"};
    ImGui::SliderFloat("exposure", &view.display.exposureStops, -10.0f, 10.0f, "%+.1f stops");
    ImGui::SameLine();
    ImGui::Checkbox("auto", &view.autoExposure);
    int curve = static_cast<int>(view.display.toneCurve);
    if (ImGui::Combo("tone curve", &curve, kCurves.data(), static_cast<int>(kCurves.size())))
        view.display.toneCurve = static_cast<ToneCurve>(curve);
}

void drawPicked(ViewState& view) {
    if (!view.picked) {
        ImGui::TextDisabled("click a vertex to see its transfer as a lobe");
        return;
    }
    ImGui::Checkbox("lobe of vertex", &view.showTransferLobe);
    ImGui::SameLine();
    ImGui::Text("%zu", view.picked->vertex);
    ImGui::SameLine();
    if (ImGui::SmallButton("Forget")) view.picked.reset();
}

void drawFile(Desk& desk) {
    ImGui::InputText("view file", &desk.viewFile);
    if (ImGui::Button("Save view")) desk.wantsSave = true;
    ImGui::SameLine();
    if (ImGui::Button("Load view")) desk.wantsLoad = true;
}

}  // namespace

void drawPictureSection(ViewState& view, Desk& desk, const Stage& stage) {
    ImGui::PushID("picture");
    const Choices choices = findChoices(stage, view.objects.size());
    drawPane(view.right ? "left" : "shows", view.left, choices);
    drawSplit(view);
    if (view.right) drawPane("right", *view.right, choices);
    ImGui::Separator();
    drawWindow(view);
    drawDisplay(view);
    ImGui::Checkbox("background", &view.showBackground);
    ImGui::SameLine();
    ImGui::Checkbox("wire frame", &view.wireFrame);
    drawPicked(view);
    if (ImGui::Button("Frame all")) view.camera.reset();
    ImGui::Separator();
    drawFile(desk);
    ImGui::PopID();
}

}  // namespace prt::viewer
