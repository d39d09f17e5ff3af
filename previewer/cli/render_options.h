// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "gl/context.h"
#include "renderer/auto_choice.h"
#include "renderer/settings.h"
#include "scene/scene.h"

namespace bounce::cli {

// Groups of options in --help that say how light is drawn.
constexpr const char* k_light_transport_group = "Light transport";
constexpr const char* k_rsm_group = "Reflective shadow maps";
constexpr const char* k_vpl_group = "Virtual point lights (technique ism)";
constexpr const char* k_ism_group = "Shadow maps of virtual point lights (technique ism)";

// Options that choose what the renderer does, shared by render and view. An empty one was not given: the
// preset decides.
struct RenderOptions {
    std::string size;
    std::string camera;
    std::string animation;
    std::optional<std::string> preset;
    std::optional<std::string> technique;
    // Preset auto: with the file `tuning` with_tuning() puts its settings in, else auto's own model chooses.
    std::optional<double> budget_ms;
    std::string tuning;
    std::optional<double> machine_speed;
    bool explain = false;

    // Reflective shadow maps.
    std::optional<std::string> samples;  // a number, or all
    std::optional<std::string> pattern;
    std::optional<bool> interpolate;
    std::optional<int> lowres;
    std::optional<std::string> rsm_size;  // a number, or auto

    // Virtual point lights.
    std::optional<int> vpls;
    std::optional<int> bounces;
    std::optional<int> bounce_vpls;
    std::optional<int> world_vpls;
    std::optional<int> emitter_vpls;
    std::optional<int> emitter_panels;
    std::optional<int> bounce_places;
    std::optional<int> interleave;
    std::optional<bool> near_field;
    std::optional<bool> glossy;
    std::optional<std::string> bounce_source;
    std::optional<int> avg_size;
    std::optional<std::string> avg_hits;
    std::optional<std::string> avg_paths;
    std::optional<std::string> vpl_sampling;
    std::optional<std::string> vpl_importance;
    std::optional<std::string> world_sampling;
    std::optional<float> importance_pixels;
    std::optional<float> importance_floor;
    std::optional<int> vpl_steps;
    std::optional<std::string> shading;
    std::optional<std::string> simplify;  // a number, or auto
    std::optional<double> simplify_error;

    // Their shadow maps.
    std::optional<std::string> visibility;
    std::optional<int> ism_size;
    std::optional<std::string> map_projection;
    std::optional<std::string> points;  // a number, or auto
    std::optional<std::string> splat;
    std::optional<bool> large_triangles;
    std::optional<std::string> hull;
    std::optional<std::string> pull_push;
    std::optional<int> pull_push_levels;
    std::optional<float> pull_threshold;
    std::optional<float> push_threshold;

    std::optional<bool> temporal_reuse;
    std::optional<bool> antialias;
    std::optional<int> samples_a_pixel;  // of a still
    std::optional<int> shadow_size;
    std::optional<std::string> direct_shadows;
    std::optional<int> transparent_layers;
    std::optional<int> shadow_samples;
    std::optional<int> soft_shadow_size;
    std::optional<int> convolution_order;
    std::optional<std::string> force;
    std::optional<double> memory_limit_mib;
    std::optional<std::string> show;
    std::optional<int> light;
    std::optional<int> vpl;
    std::optional<int> bounce;

    void add_to(CLI::App& command);
    // What only pictures that are written have.
    void add_still_to(CLI::App& command);
    // Refuses what is wrong whatever the scene, before it is read. Throws usage_error.
    void check() const;
    // Whether preset auto chooses by the scene: no paper's preset was asked for, nor a file's settings.
    [[nodiscard]] bool automatic() const;
    // The renderer's settings; the size is the scene's own where none was given. Throws usage_error, also for
    // what the scene does not have. Preset auto's settings are as it chooses them with the budget, if one was
    // given, at the machine speed that was given, else at 1.
    [[nodiscard]] Settings settings(const scene::Scene& scene) const;
    // The same with the reasons. automatic() must be true. request: what auto_request() gives, with a speed
    // or a target put in.
    [[nodiscard]] AutoChoice choice(const scene::Scene& scene, const AutoRequest& request) const;
    // What preset auto is asked for: what was typed stays.
    [[nodiscard]] AutoRequest auto_request(const scene::Scene& scene) const;
    [[nodiscard]] AutoScene described(const scene::Scene& scene, const Settings& settings) const;
    // Which animation to play (scene::k_all_animations for a file from Blender). Throws usage_error for
    // an unknown name.
    [[nodiscard]] int animation_index(const scene::Scene& scene) const;

  private:
    [[nodiscard]] Settings settings_without_scene() const;
    // Preset auto: the standard settings.
    [[nodiscard]] Settings typed_settings(const scene::Scene& scene) const;
    [[nodiscard]] FixedKnobs fixed_knobs() const;
};

// Throws usage_error for settings that the driver cannot hold.
void require_within(const gl::DeviceLimits& limits, const Settings& settings);

}  // namespace bounce::cli
