#include "apps/viewer/interface.h"

#include <array>
#include <filesystem>

#include <imgui.h>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

namespace prt::viewer {
namespace {

constexpr float kFontPixels = 15.0f;  // on a screen of content scale 1

/// Where systems keep a font that is easier to read than the one built in.
constexpr std::array kFontFiles = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
};

void loadFont(float scale) {
    ImGuiIO& io = ImGui::GetIO();
    static constexpr std::array<ImWchar, 7> kRanges = {0x20,   0x17f,  // Latin
                                                       0x370,  0x52f,  // Greek and Cyrillic
                                                       0x2010, 0x2044, 0};
    for (const char* file : kFontFiles) {
        std::error_code error;
        if (std::filesystem::is_regular_file(file, error) &&
            io.Fonts->AddFontFromFileTTF(file, kFontPixels * scale, nullptr, kRanges.data()))
            return;
    }
    ImFontConfig config;
    config.SizePixels = 13.0f * scale;  // that of its pixels
    io.Fonts->AddFontDefault(&config);
}

void setColors(ImGuiStyle& style) {
    const ImVec4 ink(0.13f, 0.15f, 0.19f, 1.0f);
    const auto shade = [](float grey, float alpha) {
        return ImVec4(grey, grey, grey + 0.01f, alpha);
    };
    const auto accent = [](float alpha) { return ImVec4(0.13f, 0.42f, 0.72f, alpha); };
    ImGui::StyleColorsLight(&style);
    ImVec4* colors = style.Colors;
    colors[ImGuiCol_Text] = ink;
    colors[ImGuiCol_TextDisabled] = ImVec4(0.42f, 0.45f, 0.5f, 1.0f);
    colors[ImGuiCol_WindowBg] = shade(0.975f, 0.95f);
    colors[ImGuiCol_PopupBg] = shade(0.985f, 0.98f);
    colors[ImGuiCol_Border] = shade(0.0f, 0.1f);
    colors[ImGuiCol_FrameBg] = shade(0.0f, 0.06f);
    colors[ImGuiCol_FrameBgHovered] = accent(0.16f);
    colors[ImGuiCol_FrameBgActive] = accent(0.26f);
    colors[ImGuiCol_CheckMark] = accent(1.0f);
    colors[ImGuiCol_SliderGrab] = accent(0.75f);
    colors[ImGuiCol_SliderGrabActive] = accent(1.0f);
    colors[ImGuiCol_Button] = shade(0.0f, 0.07f);
    colors[ImGuiCol_ButtonHovered] = accent(0.22f);
    colors[ImGuiCol_ButtonActive] = accent(0.4f);
    colors[ImGuiCol_Header] = shade(0.0f, 0.05f);
    colors[ImGuiCol_HeaderHovered] = accent(0.16f);
    colors[ImGuiCol_HeaderActive] = accent(0.26f);
    colors[ImGuiCol_Separator] = shade(0.0f, 0.12f);
    colors[ImGuiCol_ScrollbarBg] = shade(0.0f, 0.0f);
    colors[ImGuiCol_ScrollbarGrab] = shade(0.0f, 0.18f);
    colors[ImGuiCol_PlotLines] = accent(1.0f);
    colors[ImGuiCol_PlotHistogram] = accent(0.85f);
    colors[ImGuiCol_TextSelectedBg] = accent(0.3f);
    colors[ImGuiCol_NavHighlight] = accent(0.8f);
}

void setStyle(float scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 8.0f;
    style.ChildRounding = style.PopupRounding = style.FrameRounding = style.GrabRounding = 5.0f;
    style.ScrollbarRounding = 8.0f;
    style.WindowBorderSize = 1.0f;
    style.WindowPadding = {12.0f, 10.0f};
    style.FramePadding = {7.0f, 4.0f};
    style.ItemSpacing = {8.0f, 6.0f};
    style.IndentSpacing = 14.0f;
    style.ScrollbarSize = 11.0f;
    setColors(style);
    style.ScaleAllSizes(scale);
}

}  // namespace

Interface::Interface(const GlfwWindow& window) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    loadFont(window.contentScale());
    setStyle(window.contentScale());
    constexpr bool kAlsoTellsUs = true;  // callbacks that were set before are called, too
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), kAlsoTellsUs);
    ImGui_ImplOpenGL3_Init("#version 430 core");
}

Interface::~Interface() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Interface::begin() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Interface::draw() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace prt::viewer
