#include "apps/viewer/panels.h"

#include <imgui.h>

namespace prt::viewer {
namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

float marginPixels() {
    return ImGui::GetFontSize() * 0.8f;
}

void drawOpener(Desk& desk) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({size.x - marginPixels(), marginPixels()}, ImGuiCond_Always,
                            {1.0f, 0.0f});
    ImGui::Begin("opener", nullptr, kFixed | ImGuiWindowFlags_AlwaysAutoResize);
    if (ImGui::Button("Panel")) desk.isPanelOpen = true;
    ImGui::SameLine();
    if (ImGui::Button("Help")) desk.isHelpOpen = true;
    ImGui::End();
}

bool beginSection(const char* name, bool isOpen) {
    return ImGui::CollapsingHeader(name, isOpen ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

/// What the panel's own buttons do.
void drawButtons(Desk& desk) {
    if (ImGui::Button("Screenshot")) desk.wantsScreenshot = true;
    ImGui::SameLine();
    if (ImGui::Button("Help")) desk.isHelpOpen = true;
    ImGui::SameLine();
    if (ImGui::Button("Close")) desk.isPanelOpen = false;
}

}  // namespace

void drawPanel(ViewState& view, Desk& desk, const Stage& stage, LightFolder& folder) {
    if (!desk.isPanelOpen) return drawOpener(desk);
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float width = ImGui::GetFontSize() * 22.0f;
    ImGui::SetNextWindowPos({size.x - marginPixels(), marginPixels()}, ImGuiCond_Always,
                            {1.0f, 0.0f});
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, size.y - 2.0f * marginPixels()});
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PushItemWidth(ImGui::GetFontSize() * 10.5f);
    drawButtons(desk);
    if (beginSection("Light", true)) drawLightSection(view, desk, stage, folder);
    if (beginSection("Picture", true)) drawPictureSection(view, desk, stage);
    if (beginSection("Objects", false)) drawObjectSection(view, desk, stage);
    if (beginSection("Figures", false)) drawFigureSection(desk);
    ImGui::PopItemWidth();
    ImGui::End();
}

}  // namespace prt::viewer
