// SPDX-License-Identifier: Apache-2.0
#include "viewer/key_bindings.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace bounce::viewer {

std::optional<Command> command_of(const SpecialKey& key) {
    switch (key.key) {
        case GLFW_KEY_HOME:
            return Command::frame_all;
        case GLFW_KEY_LEFT:
            return key.shift ? Command::first_frame : Command::previous_frame;
        case GLFW_KEY_RIGHT:
            return key.shift ? Command::last_frame : Command::next_frame;
        case GLFW_KEY_F1:
            return Command::toggle_help;
        case GLFW_KEY_ESCAPE:
            return Command::quit;
        default:
            return std::nullopt;
    }
}

std::optional<Command> command_of(char32_t character) {
    const bool capital = character >= U'A' && character <= U'Z';
    switch (capital ? character - U'A' + U'a' : character) {
        case U' ':
            return Command::toggle_play;
        case U'f':
            return Command::frame_all;
        case U'0':
            return Command::active_camera;
        case U'c':
            return Command::next_camera;
        case U'1':
            return Command::show_shaded;
        case U'2':
            return Command::show_direct;
        case U'3':
            return Command::show_indirect;
        case U'4':
            return Command::show_rsm_depth;
        case U'5':
            return Command::show_rsm_position;
        case U'6':
            return Command::show_rsm_normal;
        case U'7':
            return Command::show_rsm_flux;
        case U'8':
            return Command::show_interpolation;
        case U'9':
            return Command::show_vpls;
        case U'm':
            return Command::show_ism;
        case U'v':
            return Command::show_vpl_visibility;
        case U',':
            return Command::previous_vpl;
        case U'.':
            return Command::next_vpl;
        case U'b':
            return Command::next_bounce;
        case U'l':
            return Command::next_light;
        case U'[':
            return Command::darker;
        case U']':
            return Command::brighter;
        case U't':
            return Command::toggle_technique;
        case U'i':
            return Command::toggle_interpolation;
        case U'h':
            return Command::toggle_panels;
        case U's':
            return Command::screenshot;
        case U'?':
            return Command::toggle_help;
        case U'q':
            return Command::quit;
        default:
            return std::nullopt;
    }
}

const std::vector<HelpLine>& help_lines() {
    static const std::vector<HelpLine> lines = {
        {"left or middle drag", "orbit"},
        {"Shift + drag", "pan"},
        {"wheel, Ctrl + drag", "zoom"},
        {"Home, F", "frame the whole scene"},
        {"0", "the scene's active camera"},
        {"C", "next camera of the scene"},
        {"Space", "play or pause"},
        {"Left, Right", "step a frame"},
        {"Shift + Left, Right", "first or last frame"},
        {"1", "shaded picture"},
        {"2", "direct light only"},
        {"3", "indirect light only"},
        {"4 5 6 7", "reflective shadow map: depth, position, normal, flux"},
        {"8", "where indirect light was interpolated"},
        {"9", "virtual point lights"},
        {"M", "their shadow maps"},
        {"V", "what one of them lights, and what its map hides"},
        {",  .", "previous, next virtual point light (for V and M)"},
        {"B", "next bounce (for 9, M and V)"},
        {"L", "next light (for 4 to 7)"},
        {"[  ]", "exposure half a stop down, up"},
        {"T", "technique: ism, rsm, direct"},
        {"I", "interpolation on or off"},
        {"S", "save PNG and EXR of the frame"},
        {"H", "hide or show the panels"},
        {"F1, ?", "this help"},
        {"Esc, Q", "quit"},
    };
    return lines;
}

}  // namespace bounce::viewer
