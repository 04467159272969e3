#include "apps/viewer/panels.h"

#include <array>
#include <filesystem>

#include <imgui.h>

#include "apps/common/text.h"

namespace prt::viewer {
namespace {

void drawLayer(const CompressedLayer& layer) {
    const std::string_view name = transportName(layer.transport);
    ImGui::BulletText("%.*s, %s, %s a vertex", static_cast<int>(name.size()), name.data(),
                      layer.channelCount == 1 ? "grey" : "RGB",
                      cli::formatBytes(bytesPerReceiver(layer)).c_str());
    if (!layer.bases) return;
    ImGui::TextDisabled("    %s of up to %zu components",
                        cli::formatCount(layer.bases->clusterCount(), "cluster").c_str(),
                        layer.bases->componentCount());
}

void drawAssetInfo(const Asset& asset) {
    std::size_t triangleCount = 0;
    for (const Mesh& mesh : asset.scene.meshes)
        triangleCount += mesh.triangleCount();
    ImGui::Text("%s, %s", cli::formatCount(asset.transfer.receiverCount, "vertex").c_str(),
                cli::formatCount(triangleCount, "triangle").c_str());
    ImGui::Text("%d bands", asset.transfer.bandCount);
    for (const CompressedLayer& layer : asset.transfer.layers)
        drawLayer(layer);
    const Provenance& made = asset.provenance;
    ImGui::TextDisabled(
        "%s rays a vertex, %s",
        cli::formatCount(static_cast<std::uint64_t>(made.sampleCount)).c_str(),
        cli::formatCount(static_cast<std::uint64_t>(made.bounceCount), "bounce").c_str());
    ImGui::TextDisabled("%s", made.generator.c_str());
}

void drawRotation(Vec3d& degrees) {
    constexpr std::array<const char*, 3> kAxes = {"turn about x", "turn about y", "turn about z"};
    constexpr double kLeast = -180.0, kMost = 180.0;
    for (int axis = 0; axis < 3; ++axis)
        ImGui::SliderScalar(kAxes[static_cast<std::size_t>(axis)], ImGuiDataType_Double,
                            &degrees[axis], &kLeast, &kMost, "%.0f\xc2\xb0");
}

/// @return whether the object is to go
bool drawObject(ObjectChoice& object, Desk& desk, std::size_t index, const Stage& stage) {
    ImGui::Checkbox("##shown", &object.isShown);
    ImGui::SameLine();
    const std::string name = std::filesystem::path(object.asset).filename().string();
    const bool isOpen =
        ImGui::TreeNodeEx("object",
                          ImGuiTreeNodeFlags_DefaultOpen | ImGuiTreeNodeFlags_OpenOnArrow |
                              (desk.selectedObject == index ? ImGuiTreeNodeFlags_Selected : 0),
                          "%s", name.c_str());
    if (ImGui::IsItemClicked()) desk.selectedObject = index;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", object.asset.c_str());
    if (!isOpen) return false;
    const auto statuses = stage.objects().statuses();
    if (index < statuses.size()) {
        if (!statuses[index].message.empty())
            ImGui::TextWrapped("%s", statuses[index].message.c_str());
        if (const auto asset = stage.objects().asset(index)) drawAssetInfo(*asset);
    }
    drawRotation(object.rotationDegrees);
    const bool isRemoved = ImGui::SmallButton("Remove");
    ImGui::TreePop();
    return isRemoved;
}

}  // namespace

void drawObjectSection(ViewState& view, Desk& desk, const Stage& stage) {
    ImGui::PushID("objects");
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < view.objects.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (drawObject(view.objects[i], desk, i, stage)) removed = i;
        ImGui::PopID();
    }
    if (removed) {
        view.objects.erase(view.objects.begin() + static_cast<std::ptrdiff_t>(*removed));
        view.picked.reset();
    }
    if (view.objects.empty()) ImGui::TextDisabled("drop a baked asset (.glb) onto the window");
    ImGui::PopID();
}

}  // namespace prt::viewer
