// SPDX-License-Identifier: Apache-2.0
#include "viewer/state_commands.h"

#include <gtest/gtest.h>

namespace bounce::viewer {
namespace {

constexpr scene::FrameRange k_range{.start = 1, .end = 10, .fps = 24.0};

struct StateCommands : testing::Test {
    ViewState state;
    Playback playback{k_range};
    Effect press(char32_t character) {
        const auto command = command_of(character);
        EXPECT_TRUE(command.has_value());
        return command ? perform_on_state(*command, state, playback, 0.0) : Effect::none;
    }
};

TEST_F(StateCommands, DigitsChooseWhatIsShown) {
    const Show shows[] = {Show::shaded,    Show::direct,        Show::indirect,
                          Show::rsm_depth, Show::rsm_position,  Show::rsm_normal,
                          Show::rsm_flux,  Show::interpolation, Show::vpls};
    char32_t digit = U'1';
    for (const Show show : shows) {
        EXPECT_EQ(press(digit++), Effect::picture_changed);
        EXPECT_EQ(state.settings.show, show);
    }
    press(U'm');
    EXPECT_EQ(state.settings.show, Show::ism);
    press(U'v');
    EXPECT_EQ(state.settings.show, Show::vpl_visibility);
}

TEST_F(StateCommands, LightsAndBouncesGoRoundThroughAll) {
    state.settings.vpls = 32;  // two whole blocks of 4 x 4
    state.settings.bounces = 2;
    EXPECT_EQ(press(U'.'), Effect::picture_changed);
    EXPECT_EQ(state.settings.shown_vpl, 0);
    press(U',');
    press(U',');
    EXPECT_EQ(state.settings.shown_vpl, 31);
    press(U'.');
    EXPECT_EQ(state.settings.shown_vpl, -1);
    for (const int bounce : {1, 2, 0}) {
        press(U'b');
        EXPECT_EQ(state.settings.shown_bounce, bounce);
    }
}

TEST_F(StateCommands, ExposureGoesByHalfStopsWithoutDrawingTheSceneAgain) {
    EXPECT_EQ(press(U']'), Effect::none);
    EXPECT_EQ(press(U']'), Effect::none);
    EXPECT_FLOAT_EQ(state.exposure_stops, 1.0F);
    press(U'[');
    EXPECT_FLOAT_EQ(shown_view(state, {.exposure = 2.0F}).exposure, 2.5F);
}

TEST_F(StateCommands, LayersOfDataAreShownWithoutTheScenesLook) {
    const scene::ViewSettings filmic{.view_transform = "Filmic", .look = "High Contrast", .exposure = 3.0F};
    EXPECT_EQ(shown_view(state, filmic).view_transform, "Filmic");
    press(U'7');
    EXPECT_EQ(shown_view(state, filmic).view_transform, "Standard");
    EXPECT_FLOAT_EQ(shown_view(state, filmic).exposure, 0.0F);
}

TEST_F(StateCommands, TogglesGoBothWays) {
    press(U't');
    EXPECT_EQ(state.settings.technique, Technique::rsm);
    press(U'T');
    EXPECT_EQ(state.settings.technique, Technique::direct);
    press(U't');
    EXPECT_EQ(state.settings.technique, Technique::ism);
    press(U'i');
    EXPECT_FALSE(state.settings.interpolate);
    press(U'h');
    EXPECT_FALSE(state.show_panels);
    press(U'?');
    EXPECT_TRUE(state.show_help);
}

TEST_F(StateCommands, SaysWhyALayerIsMissing) {
    EXPECT_TRUE(why_not_shown(state.settings, 1).empty());
    press(U'7');
    EXPECT_TRUE(why_not_shown(state.settings, 1).empty());
    EXPECT_FALSE(why_not_shown(state.settings, 0).empty());
    press(U'9');
    EXPECT_TRUE(why_not_shown(state.settings, 1).empty());
    press(U't');
    EXPECT_FALSE(why_not_shown(state.settings, 1).empty()) << "rsm has no virtual point lights";
    press(U'8');
    EXPECT_TRUE(why_not_shown(state.settings, 1).empty());
    press(U'i');
    EXPECT_FALSE(why_not_shown(state.settings, 1).empty());
}

TEST_F(StateCommands, WhatNeedsTheSceneIsLeftToTheViewer) {
    EXPECT_EQ(perform_on_state(Command::frame_all, state, playback, 0.0), Effect::not_here);
    EXPECT_EQ(perform_on_state(Command::quit, state, playback, 0.0), Effect::not_here);
}

}  // namespace
}  // namespace bounce::viewer
