// SPDX-License-Identifier: Apache-2.0
#include "viewer/picture_panels.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <imgui.h>

#include "renderer/ism_layout.h"
#include "viewer/choices.h"

namespace bounce::viewer {
namespace {

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

// Whose lights and maps a layer shows.
void choose_vpl(Settings& settings, PanelResult& result) {
    if (settings.bounces > 1) {
        result.picture_changed |= ImGui::SliderInt("of bounce", &settings.shown_bounce, 0, settings.bounces,
                                                   settings.shown_bounce > 0     ? "%d"
                                                   : settings.show == Show::vpls ? "all"
                                                                                 : "1",
                                                   ImGuiSliderFlags_AlwaysClamp);
    }
    if (shows_vpl_maps(settings.show)) {
        const int vpls = ism_layout(settings, std::max(settings.shown_bounce, 1), 0).vpls;
        settings.shown_vpl = std::min(settings.shown_vpl, vpls - 1);
        const bool all = settings.shown_vpl < 0;
        result.picture_changed |= ImGui::SliderInt("light", &settings.shown_vpl, -1, vpls - 1,
                                                   !all                                    ? "%d"
                                                   : settings.show == Show::vpl_visibility ? "0"
                                                                                           : "all",
                                                   ImGuiSliderFlags_AlwaysClamp);
    }
}

}  // namespace

void view_section(ViewState& state, Viewpoint& viewpoint, const PanelFacts& facts, PanelResult& result) {
    constexpr std::array<const char*, 15> shows = {"shaded",
                                                   "direct light",
                                                   "indirect light",
                                                   "RSM depth",
                                                   "RSM position",
                                                   "RSM normal",
                                                   "RSM flux",
                                                   "importance",
                                                   "interpolation",
                                                   "virtual lights",
                                                   "ISM splats",
                                                   "ISM atlas",
                                                   "visibility of a light",
                                                   "unblurred light",
                                                   "removed light"};
    result.picture_changed |= choose("show", shows, state.settings.show);
    if (shows_light_map(state.settings.show)) {
        choose_light(state.settings, facts, result);
    }
    if (state.settings.show == Show::vpls || shows_vpl_maps(state.settings.show)) {
        choose_vpl(state.settings, result);
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

void frame_section(ViewState& state, const PanelFacts& facts, PanelResult& result) {
    if (!ImGui::CollapsingHeader("Frame", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    const FrameReport& report = facts.report;
    ImGui::Text("%zu triangles, %d light%s", report.triangles, report.lights, report.lights == 1 ? "" : "s");
    if (report.vpls > 0) {
        ImGui::Text("%d virtual point lights", report.vpls);
    } else if (report.rsm_samples > 0) {
        ImGui::Text("%d samples a gathered pixel", report.rsm_samples);
    }
    if (report.map_size > 0) {
        ImGui::Text("maps of %d x %d, %d points each", report.map_size, report.map_size, report.points_a_map);
    }
    if (report.large_triangles > 0) {
        ImGui::Text("and %zu large triangles", report.large_triangles);
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
    for (const std::string& note : report.notes) {
        bullet(note);
    }
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
