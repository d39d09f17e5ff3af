// SPDX-License-Identifier: Apache-2.0
//
// What preset auto chooses, and what it says about it. No OpenGL.
#include "renderer/auto_choice.h"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/auto_cost.h"
#include "renderer/auto_knobs.h"
#include "renderer/settings_check.h"

namespace bounce {
namespace {

using testing::HasSubstr;
using testing::Not;

// A room with one spot, seen whole.
AutoScene room() {
    AutoScene scene;
    scene.features.triangles = 10'000;
    scene.features.spot_lights = 1;
    scene.features.reflects = true;
    scene.planar_lights = 1;
    return scene;
}

AutoRequest of_size(int width, int height) {
    AutoRequest request;
    request.base.width = width;
    request.base.height = height;
    return request;
}

AutoRequest within(double budget_ms, int width = 96, int height = 54) {
    AutoRequest request = of_size(width, height);
    request.budget_ms = budget_ms;
    return request;
}

std::string words(const AutoChoice& choice) {
    return fmt::format("{}", fmt::join(explain(choice), "\n"));
}

TEST(AutoChoice, WithoutABudgetTheStandardSettings) {
    const AutoChoice choice = choose_settings(room(), of_size(960, 540));
    EXPECT_TRUE(same_knobs(choice.settings, Settings{}));
    EXPECT_EQ(choice.settings.rsm_size, 0) << "what a technique takes by itself stays unsaid";
    EXPECT_EQ(choice.settings.shadow_samples, 0);
    EXPECT_THAT(words(choice), HasSubstr("bounced light is drawn"));
}

TEST(AutoChoice, JudgesByTheViewWhereItShowsLittle) {
    AutoScene hall = room();
    hall.seen_share = 0.12;
    const AutoChoice choice = choose_settings(hall, of_size(960, 540));
    EXPECT_EQ(choice.settings.vpl_importance, Importance::view);
    EXPECT_THAT(words(choice), HasSubstr("only 12 % of the lamps' light counts for it"));

    AutoRequest typed = of_size(960, 540);
    typed.fixed.set(bit_of(Knob::importance));
    EXPECT_EQ(choose_settings(hall, typed).settings.vpl_importance, Importance::flux)
        << "what was typed stays";
}

TEST(AutoChoice, NothingBouncesWithoutLightOrSurfaceThatReflects) {
    AutoScene black = room();
    black.features.reflects = false;
    EXPECT_EQ(choose_settings(black, of_size(8, 8)).settings.technique, Technique::direct);
    EXPECT_THAT(words(choose_settings(black, of_size(8, 8))), HasSubstr("Every surface is black"));
    AutoScene dark = room();
    dark.planar_lights = 0;
    EXPECT_EQ(choose_settings(dark, of_size(8, 8)).settings.technique, Technique::direct);
    dark.features.world_not_black = true;
    EXPECT_EQ(choose_settings(dark, of_size(8, 8)).settings.technique, Technique::ism);
}

// The more time, the smaller the error, and never more time than there is.
TEST(AutoChoice, ABudgetIsKeptAndUsed) {
    AutoScene scene = room();
    scene.features.world_not_black = true;
    scene.sized_planar = 1;
    double before = 1e9;
    for (const double budget : {60.0, 100.0, 250.0, 1000.0, 10000.0}) {
        const AutoChoice choice = choose_settings(scene, within(budget));
        EXPECT_EQ(settings_refusal(choice.settings), "");
        EXPECT_TRUE(choice.fits) << budget;
        EXPECT_LE(choice.predicted_ms, budget);
        EXPECT_NEAR(choice.predicted_ms, frame_cost_ms(scene, choice.settings), 1e-9);
        EXPECT_LE(choice.predicted_relmse, before) << budget;
        before = choice.predicted_relmse;
        EXPECT_THAT(words(choice), HasSubstr(fmt::format("of the {:.0f} ms there are", budget)));
    }
    EXPECT_EQ(choose_settings(scene, within(10000.0)).settings.vpls, 1024);
    EXPECT_LT(choose_settings(room(), within(33.0)).settings.vpls, 256);
}

TEST(AutoChoice, TheSameAnswerForTheSameQuestion) {
    const AutoChoice a = choose_settings(room(), within(33.0));
    const AutoChoice b = choose_settings(room(), within(33.0));
    EXPECT_TRUE(same_knobs(a.settings, b.settings));
    EXPECT_EQ(explain(a), explain(b));
}

// Twice as fast is as good as twice the time.
TEST(AutoChoice, AFasterMachineIsALargerBudget) {
    AutoRequest fast = within(33.0);
    fast.machine_speed = 2.0;
    EXPECT_TRUE(
        same_knobs(choose_settings(room(), fast).settings, choose_settings(room(), within(66.0)).settings));
    EXPECT_FALSE(
        same_knobs(choose_settings(room(), fast).settings, choose_settings(room(), within(33.0)).settings));
}

TEST(AutoChoice, SaysThatNothingFits) {
    const AutoChoice choice = choose_settings(room(), within(1.0, 3840, 2160));
    EXPECT_FALSE(choice.fits);
    EXPECT_EQ(choice.settings.technique, Technique::direct);
    EXPECT_FALSE(choice.settings.antialias);
    EXPECT_THAT(words(choice), HasSubstr("Nothing fits into 1.0 ms at 3840 x 2160"));
}

TEST(AutoChoice, WhatWasTypedStaysWithinABudget) {
    AutoRequest request = within(15.0);
    request.base.vpls = 700;
    request.base.antialias = true;
    for (const Knob knob : {Knob::technique, Knob::vpls, Knob::antialias}) {
        request.fixed.set(bit_of(knob));
    }
    const AutoChoice choice = choose_settings(room(), request);
    EXPECT_EQ(choice.settings.technique, Technique::ism);
    EXPECT_EQ(choice.settings.vpls, 700);
    EXPECT_TRUE(choice.settings.antialias);
    EXPECT_FALSE(choice.fits);
    EXPECT_THAT(words(choice), Not(HasSubstr("--vpls")));
}

TEST(AutoChoice, ATargetTakesTheCheapestThatReachesIt) {
    AutoRequest request = of_size(480, 270);
    double cost = 1e9;
    for (const double target : {5e-3, 1e-2, 3e-2, 1.0}) {
        request.target_relmse = target;
        const AutoChoice choice = choose_settings(room(), request);
        EXPECT_TRUE(choice.fits);
        EXPECT_LE(choice.predicted_relmse, target);
        EXPECT_LT(choice.predicted_ms, cost) << target;
        cost = choice.predicted_ms;
    }
    request.target_relmse = 1e-6;
    const AutoChoice choice = choose_settings(room(), request);
    EXPECT_FALSE(choice.fits);
    EXPECT_THAT(words(choice), HasSubstr("--converge"));
}

// Technique rsm has one bounce and no light of the world's bounces.
TEST(AutoChoice, MoreBouncesNeedLights) {
    AutoRequest request = within(12.0);
    request.base.bounces = 3;
    EXPECT_NE(choose_settings(room(), request).settings.technique, Technique::rsm);
}

TEST(AutoChoice, SpeedsAreClasses) {
    EXPECT_DOUBLE_EQ(speed_class(1.0), 1.0);
    EXPECT_DOUBLE_EQ(speed_class(1.05), 1.0);
    EXPECT_DOUBLE_EQ(speed_class(2.1), 2.0);
    EXPECT_DOUBLE_EQ(speed_class(speed_class(0.37)), speed_class(0.37));
    EXPECT_GT(speed_class(0.0), 0.0);
}

// Every knob is one of its curve's levels, falls in error towards its first, and is set and read alike.
TEST(AutoKnobs, CurvesAreInOrder) {
    AutoScene scene = room();
    scene.features.world_not_black = scene.emitters = true;
    scene.sized_cube = scene.cube_lights = 1;
    for (const Technique technique : {Technique::direct, Technique::rsm, Technique::ism}) {
        for (const KnobCurve& curve : knob_curves(scene, technique)) {
            Settings settings;
            settings.technique = technique;
            int standards = 0;
            double before = 0.0;
            for (const KnobLevel& level : curve.levels) {
                EXPECT_GE(level.error, before);
                before = level.error;
                standards += level.standard ? 1 : 0;
                set_knob(settings, curve.knob, level.value);
                EXPECT_EQ(get_knob(settings, curve.knob), level.value);
                EXPECT_FALSE(knob_words(curve.knob, level.value).empty());
                EXPECT_TRUE(knob_option(curve.knob, level.value).starts_with("--"));
            }
            EXPECT_EQ(standards, 1) << knob_option(curve.knob, 0);
            EXPECT_EQ(curve.levels.front().error, 0.0);
        }
    }
}

TEST(AutoCost, GrowsWithWhatIsAskedFor) {
    AutoScene scene = room();
    scene.features.world_not_black = true;
    Settings settings;
    const double standard = frame_cost_ms(scene, settings);
    const auto cost = [&](auto change) {
        Settings changed = settings;
        change(changed);
        return frame_cost_ms(scene, changed);
    };
    EXPECT_GT(cost([](Settings& s) { s.vpls *= 2; }), standard);
    EXPECT_GT(cost([](Settings& s) { s.ism_size = 128; }), standard);
    EXPECT_GT(cost([](Settings& s) { s.interleave = 1; }), standard);
    EXPECT_GT(cost([](Settings& s) { s.bounces = 2; }), standard);
    EXPECT_GT(cost([](Settings& s) { s.width *= 2; }), standard);
    EXPECT_LT(cost([](Settings& s) { s.antialias = false; }), standard);
    EXPECT_LT(cost([](Settings& s) { s.world_vpls = 0; }), standard);
    EXPECT_LT(cost([](Settings& s) { s.visibility = Visibility::none; }), standard);
    EXPECT_LT(cost([](Settings& s) { s.technique = Technique::direct; }), standard);
    for (const WorkItem& item : frame_work(scene, settings)) {
        EXPECT_TRUE(std::isfinite(item.ms) && item.ms > 0.0) << item.name;
    }
}

}  // namespace
}  // namespace bounce
