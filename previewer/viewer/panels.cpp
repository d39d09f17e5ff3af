// SPDX-License-Identifier: Apache-2.0
#include "viewer/panels.h"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/picture_panels.h"

namespace bounce::viewer {
namespace {

constexpr ImGuiWindowFlags k_fixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;

// Pixels on a screen of ordinary density.
constexpr float k_side_width = 292.0F;
constexpr float k_margin = 10.0F;

void side_panel(ViewState& state, Viewpoint& viewpoint, const PanelFacts& facts, float bottom,
                PanelResult& result) {
    const float scale = facts.content_scale;
    const ImVec2 room = ImGui::GetIO().DisplaySize;
    const float margin = k_margin * scale;
    ImGui::SetNextWindowPos({margin, margin});
    const float width = std::min(k_side_width * scale, room.x - 2.0F * margin);
    ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, std::max(bottom - 2.0F * margin, 1.0F)});
    if (ImGui::Begin("side", nullptr, k_fixed | ImGuiWindowFlags_AlwaysAutoResize)) {
        ImGui::PushItemWidth(width * 0.52F);
        ImGui::TextUnformatted(facts.stage.scene().name.c_str());
        const std::string cost = facts.frame_ms > 0.0 ? fmt::format("{:.1f} ms, {:.1f} fps", facts.frame_ms,
                                                                    1000.0 / facts.frame_ms)
                                                      : std::string("not measured yet");
        ImGui::TextDisabled("%d x %d   %s", state.settings.width, state.settings.height, cost.c_str());
        ImGui::Separator();
        view_section(state, viewpoint, facts, result);
        technique_section(state, result);
        frame_section(state, facts, result);
        notes_section(facts);
        ImGui::PopItemWidth();
    }
    ImGui::End();
}

// Returns where it begins, from the top.
float timeline(Playback& playback, const PanelFacts& facts, PanelResult& result) {
    const float margin = k_margin * facts.content_scale;
    const ImVec2 room = ImGui::GetIO().DisplaySize;
    const ImGuiStyle& style = ImGui::GetStyle();
    const float height = ImGui::GetFrameHeight() + 2.0F * style.WindowPadding.y;
    const float top = room.y - margin - height;
    ImGui::SetNextWindowPos({margin, top});
    ImGui::SetNextWindowSize({room.x - 2.0F * margin, height});
    if (ImGui::Begin("timeline", nullptr, k_fixed | ImGuiWindowFlags_NoScrollbar)) {
        const scene::FrameRange& range = playback.range();
        const bool still = playback.last_frame() == range.start;
        ImGui::BeginDisabled(still);
        const float button = 3.2F * ImGui::GetFontSize();
        if (ImGui::Button(playback.playing() ? "Pause" : "Play", {button, 0.0F})) {
            result.commands.push_back(Command::toggle_play);
        }
        ImGui::SameLine();
        bool loop = playback.loop();
        bool every = playback.pace() == Pace::every_frame;
        const std::string rate = fmt::format("{:g} fps", range.fps);
        const float right = ImGui::CalcTextSize("loopevery frame").x + ImGui::CalcTextSize(rate.c_str()).x +
                            2.0F * ImGui::GetFrameHeight() + 2.0F * style.ItemInnerSpacing.x +
                            3.0F * style.ItemSpacing.x;
        ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - right, 4.0F * button));
        int frame = playback.frame();
        if (ImGui::SliderInt("##frame", &frame, range.start, playback.last_frame(), "frame %d",
                             ImGuiSliderFlags_AlwaysClamp) &&
            frame != playback.frame()) {
            playback.seek(frame, facts.now_s);
            result.picture_changed = true;
        }
        ImGui::SameLine();
        if (ImGui::Checkbox("loop", &loop)) {
            playback.set_loop(loop);
        }
        ImGui::SameLine();
        if (ImGui::Checkbox("every frame", &every)) {
            playback.set_pace(every ? Pace::every_frame : Pace::realtime, facts.now_s);
        }
        ImGui::EndDisabled();
        ImGui::SameLine();
        ImGui::TextDisabled("%s", rate.c_str());
    }
    ImGui::End();
    return top;
}

void line_of_text(const char* name, const std::string& text, const ImVec4& color, float& top, float margin) {
    if (text.empty()) {
        return;
    }
    const ImVec2 room = ImGui::GetIO().DisplaySize;
    const float wrap = std::min(36.0F * ImGui::GetFontSize(), room.x - 4.0F * margin);
    ImGui::SetNextWindowPos({room.x - margin, top}, ImGuiCond_Always, {1.0F, 0.0F});
    if (ImGui::Begin(name, nullptr,
                     k_fixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs)) {
        ImGui::PushTextWrapPos(wrap);
        ImGui::PushStyleColor(ImGuiCol_Text, color);
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopStyleColor();
        ImGui::PopTextWrapPos();
        top += ImGui::GetWindowHeight() + margin;
    }
    ImGui::End();
}

void messages(const PanelFacts& facts) {
    const float margin = k_margin * facts.content_scale;
    float top = margin;
    line_of_text("problem", facts.problem, {1.0F, 0.52F, 0.45F, 1.0F}, top, margin);
    line_of_text("note", facts.note, {1.0F, 0.82F, 0.45F, 1.0F}, top, margin);
    line_of_text("message", facts.message, ImGui::GetStyleColorVec4(ImGuiCol_Text), top, margin);
}

void help(ViewState& state) {
    const ImVec2 room = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5F * room.x, 0.5F * room.y}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSizeConstraints({0.0F, 0.0F}, {room.x, room.y});
    ImGui::SetNextWindowFocus();
    if (ImGui::Begin("Keys and mouse", &state.show_help,
                     ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize) &&
        ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const HelpLine& line : help_lines()) {
            ImGui::TableNextColumn();
            ImGui::TextColored(ImGui::GetStyleColorVec4(ImGuiCol_CheckMark), "%s  ", line.keys.data());
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(line.does.data());
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

}  // namespace

PanelResult draw_panels(ViewState& state, Viewpoint& viewpoint, Playback& playback, const PanelFacts& facts) {
    PanelResult result;
    if (state.show_panels) {
        const float bottom = timeline(playback, facts, result);
        side_panel(state, viewpoint, facts, bottom, result);
    }
    messages(facts);
    if (state.show_help) {
        help(state);
    }
    return result;
}

}  // namespace bounce::viewer
