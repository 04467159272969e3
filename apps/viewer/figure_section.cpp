#include "apps/viewer/panels.h"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "apps/common/text.h"
#include "apps/viewer/gpu_memory.h"
#include "prt/base/resident_memory.h"

namespace prt::viewer {

void drawFrameGraph(const Desk& desk) {
    const FrameTimes& times = desk.frameTimes;
    const double median = times.percentile(0.5), slow = times.percentile(0.99);
    ImGui::Text("%.1f ms, %.0f frames a second", median, median > 0.0 ? 1000.0 / median : 0.0);
    ImGui::PlotLines("##times", times.milliseconds().data(),
                     static_cast<int>(times.milliseconds().size()), 0, nullptr, 0.0f,
                     static_cast<float>(std::max(slow * 1.3, 1.0)),
                     {ImGui::GetFontSize() * 18.0f, ImGui::GetFontSize() * 4.0f});
    ImGui::TextDisabled("50 %%: %.1f   95 %%: %.1f   99 %%: %.1f ms", median,
                        times.percentile(0.95), slow);
}

void drawFigureSection(const Desk& desk) {
    drawFrameGraph(desk);
    ImGui::Text("memory: %s", cli::formatBytes(residentBytes()).c_str());
    if (const auto used = usedCardBytes())
        ImGui::Text("on the graphics card, by all programs: %s", cli::formatBytes(*used).c_str());
}

}  // namespace prt::viewer
