// SPDX-License-Identifier: Apache-2.0
#include "viewer/picture_panels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

namespace bounce::viewer {
namespace {

// The slider's end; --rsm-samples takes more.
constexpr int k_most_samples = 4096;

// A drop-down list of sizes; true where another was chosen.
template <size_t N>
bool choose_size(const char* label, const std::array<int, N>& sizes, int& value) {
    bool changed = false;
    if (ImGui::BeginCombo(label, fmt::format("{}", value).c_str())) {
        for (const int size : sizes) {
            if (ImGui::Selectable(fmt::format("{}", size).c_str(), size == value) && size != value) {
                value = size;
                changed = true;
            }
        }
        ImGui::EndCombo();
    }
    return changed;
}

// A drop-down list of an enumeration's values, which count from 0 in the order of the names.
template <typename T, size_t N>
bool choose(const char* label, const std::array<const char*, N>& names, T& value) {
    int index = static_cast<int>(value);
    if (!ImGui::Combo(label, &index, names.data(), static_cast<int>(N))) {
        return false;
    }
    value = static_cast<T>(index);
    return true;
}

void choose_light(Settings& settings, const PanelFacts& facts, PanelResult& result) {
    if (facts.lights.empty()) {
        return;
    }
    const auto shown = std::min(static_cast<size_t>(settings.shown_light), facts.lights.size() - 1);
    if (ImGui::BeginCombo("light", facts.lights[shown].c_str())) {
        for (size_t i = 0; i < facts.lights.size(); ++i) {
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::Selectable(facts.lights[i].c_str(), i == shown)) {
                settings.shown_light = static_cast<int>(i);
                result.picture_changed = true;
            }
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
}

void choose_camera(Viewpoint& viewpoint, const PanelFacts& facts, PanelResult& result) {
    const Stage& stage = facts.stage;
    const int looking = viewpoint.node();
    const std::string current = viewpoint.is_free()        ? "free"
                                : looking == scene::k_none ? "the whole scene"
                                                           : stage.camera_name(looking);
    if (ImGui::BeginCombo("camera", current.c_str())) {
        for (const int node : stage.cameras()) {
            const bool active = node == stage.scene().active_camera_node;
            const std::string name = stage.camera_name(node) + (active ? " (active)" : "");
            ImGui::PushID(node);
            if (ImGui::Selectable(name.c_str(), !viewpoint.is_free() && node == looking)) {
                viewpoint.look_through(node);
                result.picture_changed = true;
            }
            ImGui::PopID();
        }
        if (stage.cameras().empty() && ImGui::Selectable("the whole scene", !viewpoint.is_free())) {
            result.commands.push_back(Command::active_camera);
        }
        ImGui::EndCombo();
    }
}

void bullet(const std::string& text) {
    ImGui::Bullet();
    ImGui::SameLine();
    ImGui::TextWrapped("%s", text.c_str());
}

}  // namespace

void view_section(ViewState& state, Viewpoint& viewpoint, const PanelFacts& facts, PanelResult& result) {
    constexpr std::array<const char*, 8> shows = {"shaded",    "direct light", "indirect light",
                                                  "RSM depth", "RSM position", "RSM normal",
                                                  "RSM flux",  "interpolation"};
    result.picture_changed |= choose("show", shows, state.settings.show);
    if (shows_rsm_layer(state.settings.show)) {
        choose_light(state.settings, facts, result);
    }
    // The picture stays; only its display changes.
    ImGui::SliderFloat("exposure", &state.exposure_stops, -8.0F, 8.0F, "%+.1f stops");
    choose_camera(viewpoint, facts, result);
    if (ImGui::Button("Frame all")) {
        result.commands.push_back(Command::frame_all);
    }
    ImGui::SameLine();
    if (ImGui::Button("Screenshot")) {
        result.commands.push_back(Command::screenshot);
    }
    ImGui::SameLine();
    if (ImGui::Button("Help")) {
        result.commands.push_back(Command::toggle_help);
    }
}

void technique_section(ViewState& state, PanelResult& result) {
    if (!ImGui::CollapsingHeader("Technique", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    Settings& settings = state.settings;
    bool changed = choose("technique", std::array{"direct", "rsm"}, settings.technique);
    if (settings.technique == Technique::rsm) {
        ImGui::BeginDisabled(settings.rsm_full_sum);
        changed |= ImGui::SliderInt("samples", &settings.rsm_samples, 1, k_most_samples, "%d",
                                    ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
        changed |= choose("pattern", std::array{"inverse square", "uniform radius", "paper, literal"},
                          settings.rsm_pattern);
        changed |= ImGui::Checkbox("interpolate", &settings.interpolate);
        if (settings.interpolate) {
            changed |= choose_size("low-res step", std::array{2, 4, 8, 16, 32}, settings.lowres_step);
        }
        ImGui::EndDisabled();
        changed |= ImGui::Checkbox("sum every texel (slow)", &settings.rsm_full_sum);
        changed |= choose_size("RSM size", std::array{64, 128, 256, 512, 1024, 2048}, settings.rsm_size);
    }
    changed |= choose_size("shadow size", std::array{256, 512, 1024, 2048, 4096}, settings.shadow_size);
    int scale = state.render_divisor == 1 ? 0 : state.render_divisor == 2 ? 1 : 2;
    if (choose("render scale", std::array{"1", "1/2", "1/4"}, scale)) {
        state.render_divisor = 1 << scale;
        changed = true;
    }
    result.picture_changed |= changed;
}

void frame_section(ViewState& state, const PanelFacts& facts, PanelResult& result) {
    if (!ImGui::CollapsingHeader("Frame", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    const FrameReport& report = facts.report;
    ImGui::Text("%zu triangles, %d light%s", report.triangles, report.lights, report.lights == 1 ? "" : "s");
    if (report.rsm_samples > 0) {
        ImGui::Text("%d samples a gathered pixel", report.rsm_samples);
    }
    ImGui::TextDisabled("%s", facts.device.c_str());
    result.picture_changed |= ImGui::Checkbox("time each pass", &state.time_passes);
    if (!state.time_passes || facts.pass_times.empty() || !ImGui::BeginTable("passes", 2)) {
        return;
    }
    ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthFixed);
    for (const gl::PassTime& pass : facts.pass_times) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(pass.name.c_str());
        ImGui::TableNextColumn();
        ImGui::Text("%.2f", pass.gpu_ms);
    }
    ImGui::EndTable();
}

void notes_section(const PanelFacts& facts) {
    const FrameReport& report = facts.report;
    if (!report.left_out.empty() && ImGui::CollapsingHeader("Left out")) {
        for (const LeftOut& item : report.left_out) {
            bullet(fmt::format("{}: {}", item.pass, item.reason));
        }
    }
    if (!report.approximations.empty() && ImGui::CollapsingHeader("Approximations")) {
        for (const std::string& approximation : report.approximations) {
            bullet(approximation);
        }
    }
    const std::vector<std::string>& warnings = facts.stage.warnings();
    const std::vector<scene::Unsupported>& unsupported = facts.stage.scene().unsupported;
    const std::string title = fmt::format("Warnings ({})###warnings", warnings.size() + unsupported.size());
    if (warnings.size() + unsupported.size() > 0 && ImGui::CollapsingHeader(title.c_str())) {
        for (const std::string& warning : warnings) {
            bullet(warning);
        }
        for (const scene::Unsupported& item : unsupported) {
            bullet(fmt::format("not exported: {}: {}", item.object, item.what));
        }
    }
}

}  // namespace bounce::viewer
