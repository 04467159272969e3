#include "apps/viewer/light_bars.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>

#include "apps/common/parse.h"
#include "apps/viewer/panels.h"
#include "prt/image/tone_curve.h"

namespace prt::viewer {
namespace {

constexpr std::array<ImU32, 3> kChannelColors = {
    IM_COL32(208, 58, 52, 255), IM_COL32(46, 148, 72, 255), IM_COL32(44, 100, 200, 255)};

double largestOf(const std::vector<Vec3d>& values) {
    double largest = 0.0;
    for (const Vec3d& value : values)
        largest = std::max({largest, std::abs(value.x), std::abs(value.y), std::abs(value.z)});
    return largest;
}

/// Groups of three bars, from the bottom up, or from the middle where there is less than nothing.
void drawBars(const char* name, const std::vector<Vec3d>& values, bool isSigned) {
    const float font = ImGui::GetFontSize();
    const ImVec2 size(font * 18.0f, font * 4.0f);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(name, size);
    ImDrawList* drawing = ImGui::GetWindowDrawList();
    drawing->AddRectFilled(corner, {corner.x + size.x, corner.y + size.y},
                           ImGui::GetColorU32(ImGuiCol_FrameBg), ImGui::GetStyle().FrameRounding);
    const double largest = largestOf(values);
    if (values.empty() || largest == 0.0) return;
    const float zero = corner.y + (isSigned ? 0.5f : 1.0f) * size.y;
    const double reach = static_cast<double>(size.y) * (isSigned ? 0.46 : 0.94);
    const float group = size.x / static_cast<float>(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        for (int channel = 0; channel < 3; ++channel) {
            const float left = corner.x + group * (static_cast<float>(i) + 0.1f +
                                                   0.8f * static_cast<float>(channel) / 3.0f);
            const auto tip = zero - static_cast<float>(values[i][channel] / largest * reach);
            drawing->AddRectFilled({left, std::min(zero, tip)},
                                   {left + 0.8f * group / 3.0f, std::max(zero, tip)},
                                   kChannelColors[static_cast<std::size_t>(channel)]);
        }
    if (!ImGui::IsItemHovered()) return;
    const float place = (ImGui::GetIO().MousePos.x - corner.x) / group;
    const std::size_t hovered =
        std::min(static_cast<std::size_t>(std::max(place, 0.0f)), values.size() - 1);
    const Vec3d& value = values[hovered];
    ImGui::SetTooltip("%zu: %.3g, %.3g, %.3g", hovered, value.x, value.y, value.z);
}

}  // namespace

std::vector<Vec3d> bandEnergies(const Lighting& lighting) {
    std::vector<Vec3d> energies(static_cast<std::size_t>(lighting.bandCount), Vec3d(0.0));
    for (int l = 0; l < lighting.bandCount; ++l)
        for (int m = -l; m <= l; ++m) {
            const Vec3d& value = lighting.coefficients[static_cast<std::size_t>(shIndex(l, m))];
            energies[static_cast<std::size_t>(l)] += value * value;
        }
    return energies;
}

void drawLightBars(const ViewState& view, const Stage& stage) {
    const int bandCount = findChoices(stage, view.objects.size()).bandCount;
    const Lighting used = stage.lightingOf(view, Pane{}, bandCount);
    std::vector<Vec3d> strengths = bandEnergies(used);
    for (Vec3d& strength : strengths)
        strength = {std::sqrt(strength.x), std::sqrt(strength.y), std::sqrt(strength.z)};
    ImGui::TextDisabled("root of the energy of each band");
    drawBars("bands", strengths, false);
    ImGui::TextDisabled("coefficients");
    drawBars("coefficients", used.coefficients, true);
}

}  // namespace prt::viewer
