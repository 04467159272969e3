#include "apps/viewer/light_folder.h"

#include <algorithm>
#include <filesystem>

#include <epoxy/gl.h>
#include <imgui.h>

#include "apps/viewer/light_text.h"
#include "prt/gpu/gl_objects.h"

namespace prt::viewer {
namespace {

bool isFile(const LightChoice& light) {
    std::error_code error;
    return !parseLightText(light.source) && std::filesystem::is_regular_file(light.source, error);
}

GlName uploadPicture(const Rgba8Image& picture) {
    GlName texture = makeTexture(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, picture.width, picture.height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, picture.pixels.data());
    return texture;
}

bool isWaiting(const Thumbnail& thumbnail) {
    return thumbnail.status.stage == LoadingStatus::Stage::waiting;
}

}  // namespace

std::string lightFolderOf(const ViewState& view) {
    const auto file = std::ranges::find_if(view.lights, isFile);
    if (file == view.lights.end()) return {};
    return std::filesystem::absolute(file->source).parent_path().string();
}

void chooseLight(ViewState& view, const std::string& file) {
    const auto former = std::ranges::find_if(view.lights, isFile);
    if (former == view.lights.end())
        view.lights.push_back({.source = file});
    else
        former->source = file;
}

unsigned LightFolder::textureOf(const Thumbnail& thumbnail) {
    const auto [found, isNew] = textures_.try_emplace(thumbnail.source);
    if (isNew) found->second = uploadPicture(*thumbnail.picture);
    return found->second.get();
}

void LightFolder::drawPictures(ViewState& view) {
    const ImGuiStyle& style = ImGui::GetStyle();
    constexpr float kColumns = 3.0f;
    const float width =
        (ImGui::GetContentRegionAvail().x - (kColumns - 1.0f) * style.ItemSpacing.x) / kColumns;
    const ImVec2 size(width, 0.5f * width);
    int column = 0;
    for (const Thumbnail& thumbnail : thumbnails_.all()) {
        if (thumbnail.status.stage == LoadingStatus::Stage::failed) continue;
        if (column++ % static_cast<int>(kColumns) != 0) ImGui::SameLine();
        ImGui::PushID(thumbnail.source.c_str());
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        if (ImGui::InvisibleButton("light", size)) chooseLight(view, thumbnail.source);
        const ImVec2 opposite(corner.x + size.x, corner.y + size.y);
        ImDrawList* drawing = ImGui::GetWindowDrawList();
        if (thumbnail.picture)
            drawing->AddImageRounded(
                reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(textureOf(thumbnail))),
                corner, opposite, {0.0f, 0.0f}, {1.0f, 1.0f}, IM_COL32_WHITE, style.FrameRounding);
        else
            drawing->AddRectFilled(corner, opposite, ImGui::GetColorU32(ImGuiCol_FrameBg),
                                   style.FrameRounding);
        if (ImGui::IsItemHovered()) {
            drawing->AddRect(corner, opposite, ImGui::GetColorU32(ImGuiCol_CheckMark),
                             style.FrameRounding, 0, 2.0f);
            ImGui::SetTooltip("%s",
                              std::filesystem::path(thumbnail.source).filename().string().c_str());
        }
        ImGui::PopID();
    }
}

void LightFolder::draw(ViewState& view) {
    isDrawn_ = true;
    const std::string folder = lightFolderOf(view);
    if (folder.empty()) {
        ImGui::TextDisabled("drop an image to see its folder");
        return;
    }
    if (folder != folder_) {
        folder_ = folder;
        textures_.clear();
        thumbnails_.open(folder_);
    }
    thumbnails_.update();
    if (!thumbnails_.status().message.empty())
        ImGui::TextWrapped("%s", thumbnails_.status().message.c_str());
    ImGui::BeginChild("pictures", {0.0f, ImGui::GetFontSize() * 10.0f});
    drawPictures(view);
    ImGui::EndChild();
}

bool LightFolder::isBusy() const {
    return isDrawn_ && std::ranges::any_of(thumbnails_.all(), isWaiting);
}

}  // namespace prt::viewer
