// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include <imgui.h>

#include "renderer/settings_check.h"
#include "viewer/choices.h"
#include "viewer/picture_panels.h"

namespace bounce::viewer {
namespace {

// The sliders' ends; the command line takes more.
constexpr int k_slider_samples = 4096;
constexpr int k_slider_vpls = 4096;
constexpr int k_slider_steps = 100;

constexpr ImGuiSliderFlags k_log = ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp;

bool rsm_settings(Settings& settings) {
    bool changed = false;
    ImGui::BeginDisabled(settings.rsm_full_sum);
    changed |= ImGui::SliderInt("samples", &settings.rsm_samples, 1, k_slider_samples, "%d", k_log);
    changed |= choose("pattern", std::array{"inverse square", "uniform radius", "paper, literal"},
                      settings.rsm_pattern);
    changed |= ImGui::Checkbox("interpolate", &settings.interpolate);
    if (settings.interpolate) {
        changed |= choose_size("low-res step", std::array{2, 4, 8, 16, 32}, settings.lowres_step);
    }
    ImGui::EndDisabled();
    changed |= ImGui::Checkbox("sum every texel (slow)", &settings.rsm_full_sum);
    return changed;
}

bool splat_settings(Settings& settings) {
    bool changed = choose("splat",
                          std::array{"disks", "squares, compute", "squares, GL points",
                                     "squares, tessellation", "squares, by the counts"},
                          settings.splat);
    changed |= choose_size("points a map", std::array{0, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768},
                           settings.ism_points);
    if (settings.splat == Splat::disks) {
        changed |= ImGui::Checkbox("large triangles as such", &settings.large_triangles);
    } else {
        changed |=
            choose("pull-push", std::array{"off", "fill holes", "as in the paper"}, settings.pull_push);
        if (settings.pull_push != PullPush::off) {
            changed |= ImGui::SliderInt("levels", &settings.pull_push_levels, 1, 3, "%d", k_log);
        }
    }
    return changed;
}

bool vpl_settings(Settings& settings) {
    bool changed = ImGui::SliderInt("lights", &settings.vpls, 1, k_slider_vpls, "%d", k_log);
    changed |=
        ImGui::SliderInt("bounces", &settings.bounces, 1, k_most_bounces, "%d", ImGuiSliderFlags_AlwaysClamp);
    if (settings.bounces > 1) {
        changed |= ImGui::SliderInt("lights a bounce", &settings.bounce_vpls, 1, k_slider_vpls, "%d", k_log);
        changed |= choose("bounces by", std::array{"points", "imperfect RSMs", "visibility grid"},
                          settings.bounce_source);
    }
    changed |=
        choose("first bounce",
               std::array{"cells of equal flux", "Halton points", "Halton, any light", "inverse transform, 2",
                          "inverse transform, 3", "Metropolis", "Metropolis, first weight",
                          "Metropolis, unreduced", "resampled", "visibility grid"},
               settings.vpl_sampling);
    changed |= choose("drawn by", std::array{"flux", "what is seen"}, settings.vpl_importance);
    if (passes::is_chain(settings.vpl_sampling)) {
        changed |= ImGui::SliderInt("steps of a chain", &settings.vpl_steps, 1, k_slider_steps, "%d", k_log);
    }
    if (settings.uses_avg()) {
        changed |= choose_size("grid", std::array{32, 64, 128, 256}, settings.avg_size);
        changed |= choose("rays end", std::array{"at slabs", "in voxels"}, settings.avg_hits);
    }
    changed |= choose_size("interleave", std::array{1, 2, 4, 8, 16}, settings.interleave);
    changed |= ImGui::Checkbox("temporal reuse", &settings.temporal_reuse);
    changed |= ImGui::Checkbox("near field", &settings.near_field);
    changed |= ImGui::Checkbox("glossy lobes", &settings.glossy_bounces);
    changed |=
        choose("visibility", std::array{"none", "imperfect maps", "maps of triangles", "simplified meshes"},
               settings.visibility);
    if (settings.visibility != Visibility::none) {
        changed |= choose_size("map size", std::array{32, 64, 128, 256}, settings.ism_size);
    }
    if (settings.visibility == Visibility::ism) {
        changed |= splat_settings(settings);
    }
    // Only maps drawn from triangles may be larger.
    if (!settings.draws_triangle_maps() || settings.world_vpls > 0) {
        settings.ism_size = std::min(settings.ism_size, k_most_ism_size);
    }
    // A bounce or a light that is no more is not shown either.
    settings.shown_bounce = std::min(settings.shown_bounce, settings.bounces);
    return changed;
}

}  // namespace

void technique_section(ViewState& state, PanelResult& result) {
    if (!ImGui::CollapsingHeader("Technique", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    Settings& settings = state.settings;
    bool changed = choose("technique", std::array{"direct", "rsm", "ism"}, settings.technique);
    if (settings.technique == Technique::rsm) {
        changed |= rsm_settings(settings);
    } else if (settings.technique == Technique::ism) {
        changed |= vpl_settings(settings);
    }
    if (settings.technique != Technique::direct) {
        changed |= choose_size("RSM size", std::array{0, 64, 128, 256, 512, 1024, 2048}, settings.rsm_size);
        changed |= choose_size("bounce places", std::array{1, 2, 4, 8, 16}, settings.bounce_places);
    }
    changed |= choose_size("world's lights", std::array{0, 64, 128, 256, 512, 1024, 2048},
                           settings.world_vpls, "not occluded");
    changed |= choose("world's lights are", std::array{"parts of the sky", "drawn"}, settings.world_sampling);
    changed |= choose_size("emitters' lights", std::array{0, 64, 128, 256, 512, 1024, 2048},
                           settings.emitter_vpls, "none");
    changed |= choose_size("emissive panels", std::array{0, 1, 2, 4, 8, 16}, settings.emitter_panels, "none");
    changed |= choose_size("shadow size", std::array{256, 512, 1024, 2048, 4096}, settings.shadow_size);
    if (choose("shadows", std::array{"hard", "soft", "convolution", "imperfect"}, settings.direct_shadows)) {
        settings.shadow_samples = settings.soft_shadow_size = 0;  // their ranges are not the same
        changed = true;
    }
    if (settings.direct_shadows == DirectShadows::convolution) {
        changed |= ImGui::SliderInt("order", &settings.convolution_order, 1, k_most_convolution_order);
        changed |=
            choose_size("soft map size", std::array{0, 128, 256, 512, 1024, 2048}, settings.soft_shadow_size);
    } else if (settings.direct_shadows == DirectShadows::vpl) {
        changed |=
            choose_size("shadow samples", std::array{0, 8, 16, 32, 64, 128, 256}, settings.shadow_samples);
        changed |=
            choose_size("soft map size", std::array{0, 128, 256, 512, 1024, 2048}, settings.soft_shadow_size);
    } else if (settings.direct_shadows == DirectShadows::ism) {
        changed |=
            choose_size("shadow samples", std::array{0, 16, 32, 64, 128, 256, 512}, settings.shadow_samples);
        changed |= choose_size("soft map size", std::array{0, 32, 64, 128, 256}, settings.soft_shadow_size);
    }
    int scale = state.render_divisor == 1 ? 0 : state.render_divisor == 2 ? 1 : 2;
    if (choose("render scale", std::array{"1", "1/2", "1/4"}, scale)) {
        state.render_divisor = 1 << scale;
        changed = true;
    }
    result.picture_changed |= changed;
}

}  // namespace bounce::viewer
