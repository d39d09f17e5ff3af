// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace bounce::viewer {

// What a key or a button asks for.
enum class Command {
    frame_all,
    toggle_play,
    previous_frame,
    next_frame,
    first_frame,
    last_frame,
    active_camera,
    next_camera,
    show_shaded,
    show_direct,
    show_indirect,
    show_rsm_depth,
    show_rsm_position,
    show_rsm_normal,
    show_rsm_flux,
    show_interpolation,
    show_vpls,
    show_ism,
    show_vpl_visibility,
    next_light,
    previous_vpl,
    next_vpl,
    next_bounce,
    darker,
    brighter,
    toggle_technique,
    toggle_interpolation,
    toggle_panels,
    screenshot,
    toggle_help,
    quit,
};

// A key that types nothing; numbers are GLFW's.
struct SpecialKey {
    int key = 0;
    bool shift = false;
};

[[nodiscard]] std::optional<Command> command_of(const SpecialKey& key);
// By the character that the key types, so that any keyboard layout works; capitals count as small.
[[nodiscard]] std::optional<Command> command_of(char32_t character);

// One line of the help: what to press or drag, and what it does.
struct HelpLine {
    std::string_view keys;
    std::string_view does;
};
[[nodiscard]] const std::vector<HelpLine>& help_lines();

}  // namespace bounce::viewer
