#include "apps/viewer/panels.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>

#include "apps/viewer/light_text.h"

namespace prt::viewer {
namespace {

/// What a light is called where there is little room.
std::string shortName(const LightChoice& light) {
    if (const auto text = parseLightText(light.source)) return lightKindName(text->kind);
    return std::filesystem::path(light.source).filename().string();
}

bool sliderOf(const char* name, double& value, double least, double most, const char* format) {
    return ImGui::SliderScalar(name, ImGuiDataType_Double, &value, &least, &most, format,
                               ImGuiSliderFlags_AlwaysClamp);
}

/// The sliders of a light that is made of numbers.
void drawNumbers(LightChoice& light) {
    std::optional<LightText> text = parseLightText(light.source);
    if (!text) return;
    bool isChanged = false;
    for (std::size_t i = 0; i < text->numbers.size(); ++i) {
        const LightNumber& number = lightNumbers(text->kind)[i];
        isChanged |= sliderOf(number.name, text->numbers[i], number.least, number.most, "%.1f");
    }
    if (isChanged) light.source = formatLightText(*text);
}

/// @return whether the light is to go
bool drawLight(LightChoice& light, const LoadingStatus& status) {
    ImGui::Checkbox("##on", &light.isOn);
    ImGui::SameLine();
    const std::string name = shortName(light);
    const bool isOpen =
        ImGui::TreeNodeEx("light", ImGuiTreeNodeFlags_DefaultOpen, "%s", name.c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", light.source.c_str());
    if (!isOpen) return false;
    if (!status.message.empty()) ImGui::TextWrapped("%s", status.message.c_str());
    sliderOf("stops", light.stops, -10.0, 10.0, "%+.1f");
    if (!parseLightText(light.source))
        sliderOf("azimuth", light.azimuthDegrees, -180.0, 180.0, "%.0f\xc2\xb0");
    drawNumbers(light);
    const bool isRemoved = ImGui::SmallButton("Remove");
    ImGui::TreePop();
    return isRemoved;
}

void drawAdder(ViewState& view) {
    constexpr std::array kKinds = {LightKind::sun, LightKind::sky, LightKind::daylight,
                                   LightKind::uniform};
    if (ImGui::Button("Add a light")) ImGui::OpenPopup("kinds");
    if (!ImGui::BeginPopup("kinds")) return;
    for (const LightKind kind : kKinds)
        if (ImGui::MenuItem(lightKindName(kind)))
            view.lights.push_back(
                {.source = formatLightText(usualLight(kind)), .stops = usualStops(kind)});
    ImGui::TextDisabled("or drop an image onto the window");
    ImGui::EndPopup();
}

void drawTurning(ViewState& view) {
    constexpr std::array<const char*, 3> kAxes = {"turn about x", "turn about y", "turn about z"};
    for (int axis = 0; axis < 3; ++axis)
        sliderOf(kAxes[static_cast<std::size_t>(axis)], view.lightRotationDegrees[axis], -180.0,
                 180.0, "%.0f\xc2\xb0");
    if (ImGui::SmallButton("Turn back")) view.lightRotationDegrees = Vec3d(0.0);
}

}  // namespace

void drawLightSection(ViewState& view, Desk& desk, const Stage& stage, LightFolder& folder) {
    ImGui::PushID("lights");
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < view.lights.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const auto statuses = stage.lights().statuses();
        if (drawLight(view.lights[i], i < statuses.size() ? statuses[i] : LoadingStatus{}))
            removed = i;
        ImGui::PopID();
    }
    if (removed) view.lights.erase(view.lights.begin() + static_cast<std::ptrdiff_t>(*removed));
    drawAdder(view);
    ImGui::SameLine();
    ImGui::Checkbox("drops replace", &desk.dropsReplaceLights);
    if (ImGui::TreeNode("Images of the folder")) {
        folder.draw(view);
        ImGui::TreePop();
    }
    if (ImGui::TreeNode("Turned")) {
        drawTurning(view);
        ImGui::TreePop();
    }
    if (ImGui::TreeNode("Coefficients")) {
        ImGui::Checkbox("as a lobe", &view.showLightLobe);
        drawLightBars(view, stage);
        ImGui::TreePop();
    }
    ImGui::PopID();
}

}  // namespace prt::viewer
