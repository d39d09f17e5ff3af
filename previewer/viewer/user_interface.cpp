// SPDX-License-Identifier: Apache-2.0
#include "viewer/user_interface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

namespace bounce::viewer {
namespace {

namespace fs = std::filesystem;

// A readable font of the system: DejaVu Sans, which most distributions carry, where each puts it under
// the data folders of the XDG base directory specification.
std::optional<fs::path> find_font() {
    const char* variable = std::getenv("XDG_DATA_DIRS");
    std::istringstream folders(variable != nullptr && *variable != '\0' ? variable
                                                                        : "/usr/local/share:/usr/share");
    std::string folder;
    while (std::getline(folders, folder, ':')) {
        for (const char* place : {"truetype/dejavu", "dejavu-sans-fonts", "dejavu", "TTF"}) {
            const fs::path file = fs::path(folder) / "fonts" / place / "DejaVuSans.ttf";
            std::error_code code;
            if (fs::is_regular_file(file, code)) {
                return file;
            }
        }
    }
    return std::nullopt;
}

void add_font(float scale) {
    // Latin, Greek and Cyrillic, for names in scenes.
    static constexpr std::array<ImWchar, 5> ranges = {0x20, 0x24F, 0x370, 0x4FF, 0};
    ImGuiIO& io = ImGui::GetIO();
    if (const auto file = find_font()) {
        constexpr float size = 14.0F;
        ImFontConfig config;
        config.OversampleH = 3;
        config.OversampleV = 1;
        config.PixelSnapH = false;
        if (io.Fonts->AddFontFromFileTTF(file->c_str(), std::round(size * scale), &config, ranges.data()) !=
            nullptr) {
            return;
        }
    }
    // ImGui's own is a 13-pixel bitmap, which only whole multiples keep sharp.
    ImFontConfig config;
    config.SizePixels = 13.0F * std::max(1.0F, std::round(scale));
    io.Fonts->AddFontDefault(&config);
}

ImVec4 grey(float level, float alpha = 1.0F) {
    return {level, level, level * 1.06F, alpha};
}

void set_style(float scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 6.0F;
    style.ChildRounding = style.PopupRounding = style.FrameRounding = style.GrabRounding = 4.0F;
    style.WindowBorderSize = style.FrameBorderSize = 0.0F;
    style.WindowPadding = {10.0F, 10.0F};
    style.FramePadding = {7.0F, 3.0F};
    style.ItemSpacing = {8.0F, 5.0F};
    style.ItemInnerSpacing = {6.0F, 4.0F};
    style.ScrollbarSize = 11.0F;
    style.IndentSpacing = 12.0F;
    style.GrabMinSize = 8.0F;

    const ImVec4 accent{0.93F, 0.55F, 0.22F, 1.0F};
    // A slider's number stays readable under its handle.
    const ImVec4 handle{0.93F, 0.55F, 0.22F, 0.6F};
    ImVec4* colors = static_cast<ImVec4*>(style.Colors);
    colors[ImGuiCol_WindowBg] = grey(0.09F, 0.90F);
    colors[ImGuiCol_PopupBg] = grey(0.11F, 0.98F);
    colors[ImGuiCol_Text] = grey(0.90F);
    colors[ImGuiCol_TextDisabled] = grey(0.55F);
    colors[ImGuiCol_FrameBg] = grey(0.20F, 0.9F);
    colors[ImGuiCol_FrameBgHovered] = grey(0.27F);
    colors[ImGuiCol_FrameBgActive] = grey(0.31F);
    colors[ImGuiCol_Button] = grey(0.24F);
    colors[ImGuiCol_ButtonHovered] = grey(0.33F);
    colors[ImGuiCol_ButtonActive] = grey(0.40F);
    colors[ImGuiCol_Header] = grey(0.17F);
    colors[ImGuiCol_HeaderHovered] = grey(0.25F);
    colors[ImGuiCol_HeaderActive] = grey(0.30F);
    colors[ImGuiCol_Separator] = grey(0.25F);
    colors[ImGuiCol_CheckMark] = accent;
    colors[ImGuiCol_SliderGrab] = handle;
    colors[ImGuiCol_SliderGrabActive] = {1.0F, 0.66F, 0.34F, 0.85F};
    colors[ImGuiCol_TitleBg] = colors[ImGuiCol_TitleBgActive] = grey(0.17F);
    style.ScaleAllSizes(scale);
}

}  // namespace

UserInterface::UserInterface(GLFWwindow* window, float content_scale) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // leave no file behind in the working folder
    io.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
    set_style(content_scale);
    add_font(content_scale);
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 450 core");
}

UserInterface::~UserInterface() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void UserInterface::begin() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void UserInterface::draw() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool UserInterface::wants_mouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}

bool UserInterface::wants_text() const {
    return ImGui::GetIO().WantTextInput;
}

}  // namespace bounce::viewer
