// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "renderer/settings.h"
#include "scene/scene.h"

namespace bounce::cli {

// Options that choose what the renderer does, shared by render and view.
struct RenderOptions {
    std::string size;
    std::string camera;
    std::string animation;
    std::string technique = "rsm";
    std::string samples = "224";
    std::string pattern = "uniform-radius";
    std::string show = "shaded";
    bool interpolate = true;
    int lowres = 4;
    int rsm_size = 0;
    int vpls = 256;
    std::string visibility = "ism";
    int ism_size = 64;
    int points = 0;
    int interleave = 4;
    bool near_field = true;
    int bounces = 1;
    int bounce_vpls = 128;
    std::string splat = "disks";
    std::string pull_push = "fill";
    bool large_triangles = true;
    bool drop_hull = true;
    bool splat_irsms = false;
    bool glossy_bounces = true;
    bool antialias = true;
    int shadow_size = 2048;
    int light = 0;

    void add_to(CLI::App& command);
    // The renderer's settings; the size is the scene's own where none was given. Throws usage_error.
    [[nodiscard]] Settings settings(const scene::Scene& scene) const;
    // Which animation to play (scene::k_all_animations for a file from Blender). Throws usage_error for
    // an unknown name.
    [[nodiscard]] int animation_index(const scene::Scene& scene) const;
};

}  // namespace bounce::cli
