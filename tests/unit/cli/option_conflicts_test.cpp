// SPDX-License-Identifier: Apache-2.0
//
// Options that were given and would have no effect are refused with the reason; what the defaults say is not.
#include "cli/option_conflicts.h"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace bounce::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string conflict(const std::function<void(RenderOptions&)>& give, const Settings& settings) {
    RenderOptions options;
    give(options);
    return option_conflict(options, settings);
}

TEST(OptionConflicts, NothingGivenIsNoConflictWhateverTheSettings) {
    for (const Technique technique : {Technique::direct, Technique::rsm, Technique::ism}) {
        for (const Visibility visibility :
             {Visibility::none, Visibility::ism, Visibility::shadow_maps, Visibility::simplified}) {
            EXPECT_EQ(option_conflict({}, {.technique = technique, .visibility = visibility}), "");
        }
    }
}

TEST(OptionConflicts, OptionsOfAnotherTechnique) {
    const Settings rsm{.technique = Technique::rsm};
    const Settings ism{.technique = Technique::ism};
    const Settings direct{.technique = Technique::direct};
    const auto vpls = [](RenderOptions& o) { o.vpls = 64; };
    const auto samples = [](RenderOptions& o) { o.samples = "64"; };
    EXPECT_THAT(conflict(vpls, rsm), AllOf(HasSubstr("--vpls"), HasSubstr("technique rsm")));
    EXPECT_THAT(conflict(vpls, direct), HasSubstr("--vpls"));
    EXPECT_EQ(conflict(vpls, ism), "");
    EXPECT_THAT(conflict(samples, ism), AllOf(HasSubstr("--rsm-samples"), HasSubstr("technique ism")));
    EXPECT_EQ(conflict(samples, rsm), "");
}

TEST(OptionConflicts, HardShadowsHaveNoPlacesOnTheLight) {
    const auto places = [](RenderOptions& o) { o.shadow_samples = 32; };
    const auto size = [](RenderOptions& o) { o.soft_shadow_size = 256; };
    const Settings hard{.direct_shadows = DirectShadows::hard};
    EXPECT_THAT(conflict(places, hard),
                AllOf(HasSubstr("--shadow-samples"), HasSubstr("--direct-shadows vpl")));
    EXPECT_THAT(conflict(size, hard), HasSubstr("--soft-shadow-size"));
    EXPECT_EQ(conflict(places, {}), "");
}

TEST(OptionConflicts, AConvolutionHasAnOrderAndOneMap) {
    const auto places = [](RenderOptions& o) { o.shadow_samples = 32; };
    const auto order = [](RenderOptions& o) { o.convolution_order = 8; };
    const Settings convolution{.direct_shadows = DirectShadows::convolution};
    EXPECT_THAT(conflict(places, convolution), HasSubstr("one map a light"));
    EXPECT_EQ(conflict(order, convolution), "");
    EXPECT_THAT(conflict(order, {}), AllOf(HasSubstr("--convolution-order"), HasSubstr("vpl")));
}

TEST(OptionConflicts, ImperfectShadowsAreSplattedInAnyTechnique) {
    const auto places = [](RenderOptions& o) { o.shadow_samples = 512; };
    const auto points = [](RenderOptions& o) { o.points = "4096"; };
    const auto order = [](RenderOptions& o) { o.convolution_order = 8; };
    const auto fill = [](RenderOptions& o) { o.pull_push = "fill"; };
    const auto size = [](RenderOptions& o) { o.ism_size = 64; };
    Settings s{.technique = Technique::direct};
    EXPECT_THAT(conflict(points, s), HasSubstr("virtual point lights"));
    s.direct_shadows = DirectShadows::ism;
    EXPECT_EQ(conflict(points, s), "");
    EXPECT_EQ(conflict(places, s), "");
    EXPECT_THAT(conflict(order, s), AllOf(HasSubstr("--convolution-order"), HasSubstr("ism")));
    EXPECT_THAT(conflict(size, s), HasSubstr("virtual point lights"))
        << "--soft-shadow-size is that of a place's";
    s.pull_push = PullPush::fill;
    EXPECT_THAT(conflict(fill, s), HasSubstr("needs --splat compute, points or tessellation"));
    s = {.visibility = Visibility::none, .direct_shadows = DirectShadows::ism};
    EXPECT_EQ(conflict(points, s), "");
    EXPECT_THAT(conflict(size, s), HasSubstr("--visibility none"));
}

TEST(OptionConflicts, PresetAndTechniqueBothChooseTheTechnique) {
    const auto both = [](RenderOptions& o) {
        o.preset = "ism2008";
        o.technique = "ism";
    };
    EXPECT_THAT(conflict(both, {}), AllOf(HasSubstr("--preset ism2008"), HasSubstr("--technique")));
    EXPECT_EQ(conflict([](RenderOptions& o) { o.preset = "ism2008"; }, {}), "");
}

TEST(OptionConflicts, MapsThatAreNotDrawn) {
    const Settings none{.visibility = Visibility::none};
    const Settings classic{.visibility = Visibility::shadow_maps};
    const auto points = [](RenderOptions& o) { o.points = "100"; };
    const auto size = [](RenderOptions& o) { o.ism_size = 64; };
    EXPECT_THAT(conflict(points, none), AllOf(HasSubstr("--points"), HasSubstr("--visibility none")));
    EXPECT_THAT(conflict(size, none), HasSubstr("--ism-size"));
    EXPECT_THAT(conflict(points, classic),
                AllOf(HasSubstr("--points"), HasSubstr("--visibility shadow-maps")));
    EXPECT_EQ(conflict(size, classic), "") << "classic maps have a size, too";
    EXPECT_EQ(conflict(points, {}), "");
}

TEST(OptionConflicts, SimplifiedMeshesMustBeDrawn) {
    const Settings simplified{.visibility = Visibility::simplified};
    const Settings hybrid{.shading = Shading::hybrid};
    const Settings classic{.visibility = Visibility::shadow_maps};
    const auto ratio = [](RenderOptions& o) { o.simplify = "0.5"; };
    const auto error = [](RenderOptions& o) { o.simplify_error = 0.1; };
    const auto projection = [](RenderOptions& o) { o.map_projection = "paraboloid"; };
    for (const auto& [give, name] :
         {std::pair<std::function<void(RenderOptions&)>, const char*>(ratio, "--simplify "),
          {error, "--simplify-error "}}) {
        EXPECT_THAT(conflict(give, {}), AllOf(HasSubstr(name), HasSubstr("--visibility simplified")));
        EXPECT_THAT(conflict(give, classic), HasSubstr(name));
        EXPECT_THAT(conflict(give, {.technique = Technique::rsm}), HasSubstr("technique rsm"));
        EXPECT_EQ(conflict(give, simplified), "");
        EXPECT_EQ(conflict(give, hybrid), "");
    }
    EXPECT_THAT(conflict(projection, {}), AllOf(HasSubstr("--map-projection"), HasSubstr("shadow-maps")));
    EXPECT_EQ(conflict(projection, classic), "");
    EXPECT_EQ(conflict(projection, simplified), "");
    EXPECT_THAT(conflict([](RenderOptions& o) { o.points = "100"; }, simplified),
                AllOf(HasSubstr("--points"), HasSubstr("--visibility simplified")));
    EXPECT_THAT(conflict([](RenderOptions& o) { o.vpl_sampling = "uniform"; }, {.technique = Technique::rsm}),
                HasSubstr("--vpl-sampling"));
}

TEST(OptionConflicts, PullPushNeedsHoles) {
    const Settings disks{.splat = Splat::disks, .pull_push = PullPush::fill};
    const Settings squares{.splat = Splat::compute, .pull_push = PullPush::fill};
    const auto fill = [](RenderOptions& o) { o.pull_push = "fill"; };
    const auto push = [](RenderOptions& o) { o.push_threshold = 0.1F; };
    EXPECT_THAT(conflict(fill, disks), HasSubstr("--splat compute, points or tessellation"));
    EXPECT_EQ(conflict(fill, squares), "");
    EXPECT_EQ(conflict([](RenderOptions& o) { o.pull_push = "off"; },
                       {.splat = Splat::disks, .pull_push = PullPush::off}),
              "")
        << "off is what disks have";
    EXPECT_THAT(conflict([](RenderOptions& o) { o.pull_push_levels = 1; },
                         {.splat = Splat::compute, .pull_push = PullPush::off}),
                HasSubstr("--pull-push off"));
    EXPECT_THAT(conflict(push, squares), HasSubstr("--pull-push paper"));
    EXPECT_EQ(conflict(push, {.splat = Splat::compute, .pull_push = PullPush::paper}), "");
    EXPECT_THAT(conflict([](RenderOptions& o) { o.large_triangles = true; }, squares),
                HasSubstr("--splat disks"));
}

TEST(OptionConflicts, FurtherBouncesNeedMoreThanOne) {
    const auto of = [](RenderOptions& o) { o.bounce_vpls = 32; };
    EXPECT_THAT(conflict(of, {.bounces = 1, .world_vpls = 0, .emitter_vpls = 0}),
                AllOf(HasSubstr("--bounce-vpls"), HasSubstr("--bounces 2")));
    EXPECT_EQ(conflict(of, {.bounces = 1}), "") << "the world's light bounces, and that of what emits";
    EXPECT_EQ(conflict(of, {.bounces = 2}), "");
}

TEST(OptionConflicts, SamplersHaveTheirOwnOptions) {
    const auto steps = [](RenderOptions& o) { o.vpl_steps = 5; };
    const auto importance = [](RenderOptions& o) { o.vpl_importance = "view"; };
    const auto pixels = [](RenderOptions& o) { o.importance_pixels = 1.0F; };
    const auto floor = [](RenderOptions& o) { o.importance_floor = 0.0F; };
    const auto world = [](RenderOptions& o) { o.world_sampling = "drawn"; };
    const Settings chain{.vpl_sampling = VplSampling::metropolis};
    const Settings viewed{.vpl_importance = Importance::view};
    EXPECT_THAT(conflict(steps, {}), AllOf(HasSubstr("--vpl-steps"), HasSubstr("inverse-transform")));
    EXPECT_EQ(conflict(steps, chain), "");
    EXPECT_THAT(conflict(importance, {.vpl_sampling = VplSampling::uniform3}),
                AllOf(HasSubstr("--vpl-importance"), HasSubstr("uniform3")));
    EXPECT_EQ(
        conflict(importance, {.world_sampling = WorldSampling::drawn, .vpl_sampling = VplSampling::uniform3}),
        "");
    EXPECT_EQ(conflict(importance, viewed), "");
    EXPECT_THAT(conflict(pixels, {}), AllOf(HasSubstr("--importance-pixels"), HasSubstr("view")));
    EXPECT_THAT(conflict(floor, {}), HasSubstr("--importance-floor"));
    EXPECT_EQ(conflict(floor, viewed), "");
    EXPECT_THAT(conflict(importance, {.technique = Technique::rsm}), HasSubstr("technique rsm"));
    EXPECT_THAT(conflict(world, {.world_vpls = 0}), HasSubstr("--world-sampling"));
    EXPECT_EQ(conflict(world, {}), "");
}

TEST(OptionConflicts, LayersHaveTheirOwnOptions) {
    const auto light = [](RenderOptions& o) { o.light = 0; };
    const auto vpl = [](RenderOptions& o) { o.vpl = 5; };
    const auto bounce = [](RenderOptions& o) { o.bounce = 1; };
    EXPECT_THAT(conflict(light, {}), AllOf(HasSubstr("--light"), HasSubstr("--show shaded")));
    EXPECT_THAT(conflict(vpl, {.show = Show::vpls}), AllOf(HasSubstr("--vpl "), HasSubstr("vpl-visibility")));
    EXPECT_THAT(conflict(bounce, {}), HasSubstr("--bounce "));
    EXPECT_EQ(conflict(light, {.show = Show::rsm_flux}), "");
    EXPECT_EQ(conflict(vpl, {.show = Show::ism}), "");
    EXPECT_EQ(conflict(bounce, {.show = Show::vpls}), "");
}

TEST(OptionConflicts, AFullSumHasNoPatternAndNoInterpolation) {
    const Settings all{.technique = Technique::rsm, .rsm_full_sum = true};
    EXPECT_THAT(conflict([](RenderOptions& o) { o.pattern = "paper-literal"; }, all),
                HasSubstr("--rsm-samples all"));
    EXPECT_EQ(conflict([](RenderOptions& o) { o.interpolate = false; }, all), "");
    EXPECT_THAT(
        conflict([](RenderOptions& o) { o.lowres = 4; }, {.technique = Technique::rsm, .interpolate = false}),
        HasSubstr("--rsm-interpolation off"));
}

}  // namespace
}  // namespace bounce::cli
