// SPDX-License-Identifier: Apache-2.0
#include "renderer/settings_check.h"

#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/presets.h"
#include "renderer/setting_names.h"

namespace bounce {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string refusal(const std::function<void(Settings&)>& change) {
    Settings settings;
    change(settings);
    return settings_refusal(settings);
}

// Refused just outside both ends, and not on them.
void expect_range(const std::string& name, int low, int high,
                  const std::function<void(Settings&, int)>& give) {
    for (const int wrong : {low - 1, high + 1}) {
        EXPECT_THAT(refusal([&](Settings& s) { give(s, wrong); }),
                    AllOf(HasSubstr(name + " is " + std::to_string(wrong)), HasSubstr(std::to_string(high))));
    }
    for (const int right : {low, high}) {
        EXPECT_EQ(refusal([&](Settings& s) { give(s, right); }), "") << name << " " << right;
    }
}

TEST(SettingsRefusal, EveryPresetCanBeDrawn) {
    for (const Preset preset : {Preset::automatic, Preset::rsm2005, Preset::ism2008, Preset::lv2009,
                                Preset::avg2012, Preset::metropolis2013}) {
        EXPECT_EQ(settings_refusal(preset_settings(preset)), "");
        EXPECT_EQ(limits_refusal(preset_settings(preset), {}), "");
        EXPECT_EQ(layer_refusal(preset_settings(preset)), "");
    }
}

TEST(SettingsRefusal, ImportanceAndChainsHaveRanges) {
    EXPECT_THAT(refusal([](Settings& s) { s.vpl_steps = 0; }), HasSubstr("--vpl-steps is 0"));
    EXPECT_THAT(refusal([](Settings& s) { s.vpl_steps = 1001; }), HasSubstr("--vpl-steps is 1001"));
    for (const float pixels : {0.0F, -1.0F, 10.5F, std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_THAT(refusal([&](Settings& s) { s.importance_pixels = pixels; }),
                    HasSubstr("--importance-pixels"));
    }
    for (const float floor : {-0.1F, 1.1F, std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_THAT(refusal([&](Settings& s) { s.importance_floor = floor; }),
                    HasSubstr("--importance-floor"));
    }
    EXPECT_EQ(refusal([](Settings& s) {
                  s.vpl_steps = 1;
                  s.importance_pixels = 10.0F;
                  s.importance_floor = 0.0F;
              }),
              "");
}

TEST(SettingsRefusal, Metropolis2013IsThePaperSettings) {
    const Settings s = preset_settings(Preset::metropolis2013);
    EXPECT_EQ(s.technique, Technique::ism);
    EXPECT_EQ(s.vpls, 1024);
    EXPECT_EQ(s.ism_size * 32, 2048) << "an atlas of 32 x 32 maps";
    EXPECT_EQ(s.vpl_sampling, VplSampling::metropolis);
    EXPECT_EQ(s.vpl_importance, Importance::view);
    EXPECT_EQ(s.world_sampling, WorldSampling::drawn);
    EXPECT_FLOAT_EQ(s.importance_pixels, 0.1F);
    EXPECT_EQ(s.importance_floor, 0.0F);
    EXPECT_EQ(s.splat, Splat::tessellation);
    EXPECT_FALSE(s.temporal_reuse);
}

TEST(SettingsRefusal, Lv2009IsThePaperSettings) {
    const Settings s = preset_settings(Preset::lv2009);
    EXPECT_EQ(s.technique, Technique::ism);
    EXPECT_EQ(s.vpls, 256);
    EXPECT_EQ(s.ism_size, 256);
    EXPECT_EQ(s.bounces, 1);
    EXPECT_EQ(s.interleave, 1);
    EXPECT_EQ(s.visibility, Visibility::simplified);
    EXPECT_EQ(s.vpl_sampling, VplSampling::uniform);
    EXPECT_EQ(s.map_projection, MapProjection::paraboloid);
    EXPECT_EQ(s.simplify.ratio, 0.0) << "automatic";
    EXPECT_EQ(s.soft_shadow_size, 512);
    EXPECT_EQ(s.used_rsm_size(), 512);
    EXPECT_FALSE(s.near_field);
    EXPECT_FALSE(s.glossy_bounces);
}

TEST(SettingsRefusal, MapsOfTrianglesMayBeLarger) {
    const auto sized = [](Visibility visibility, int size, int world) {
        return refusal([&](Settings& s) {
            s.visibility = visibility;
            s.ism_size = size;
            s.world_vpls = world;
        });
    };
    for (const Visibility triangles : {Visibility::shadow_maps, Visibility::simplified}) {
        EXPECT_EQ(sized(triangles, 1024, 0), "");
        EXPECT_THAT(sized(triangles, 2048, 0), HasSubstr("from 32 to 1024"));
        EXPECT_THAT(sized(triangles, 512, 64), HasSubstr("--world-vpls 0"));
        EXPECT_EQ(sized(triangles, 256, 64), "");
    }
    EXPECT_THAT(sized(Visibility::ism, 512, 0), HasSubstr("from 32 to 256"));
}

TEST(SettingsRefusal, SimplificationHasItsRanges) {
    for (const double wrong : {-0.1, 1.01, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THAT(refusal([&](Settings& s) { s.simplify.ratio = wrong; }), HasSubstr("--simplify is"));
    }
    for (const double wrong : {0.0, -1.0, 1.5, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THAT(refusal([&](Settings& s) { s.simplify.error = wrong; }),
                    HasSubstr("--simplify-error is"));
    }
    EXPECT_EQ(refusal([](Settings& s) { s.simplify = {.ratio = 1.0, .error = 1.0}; }), "");
}

TEST(SettingsRefusal, NamesTheSettingAndItsRange) {
    expect_range("--vpls", 1, 16384, [](Settings& s, int v) { s.vpls = v; });
    expect_range("--bounces", 1, 4, [](Settings& s, int v) { s.bounces = v; });
    expect_range("--bounce-vpls", 1, 16384, [](Settings& s, int v) { s.bounce_vpls = v; });
    expect_range("--world-vpls", 0, 16384, [](Settings& s, int v) { s.world_vpls = v; });
    expect_range("--emitter-vpls", 0, 16384, [](Settings& s, int v) { s.emitter_vpls = v; });
    expect_range("--emitter-panels", 0, 64, [](Settings& s, int v) { s.emitter_panels = v; });
    expect_range("--points", 0, 65536, [](Settings& s, int v) { s.ism_points = v; });
    expect_range("--pull-push-levels", 1, 3, [](Settings& s, int v) { s.pull_push_levels = v; });
    expect_range("--rsm-samples", 1, 32768, [](Settings& s, int v) { s.rsm_samples = v; });
    expect_range("--rsm-lowres", 2, 64, [](Settings& s, int v) { s.lowres_step = v; });
    expect_range("--shadow-size", 2, 16384, [](Settings& s, int v) { s.shadow_size = v; });
    expect_range("--transparent-layers", 0, 16, [](Settings& s, int v) { s.transparent_layers = v; });
    expect_range("--shadow-samples", 8, 256, [](Settings& s, int v) { s.shadow_samples = v; });
    EXPECT_THAT(refusal([](Settings& s) { s.shadow_samples = 48; }), HasSubstr("power of two"));
    EXPECT_THAT(refusal([](Settings& s) { s.shadow_samples = 512; }), HasSubstr("or --direct-shadows ism"));
    const auto imperfect = [](Settings& s, int samples, int size) {
        s.direct_shadows = DirectShadows::ism;
        s.shadow_samples = samples;
        s.soft_shadow_size = size;
    };
    expect_range("--shadow-samples", 8, 512, [&](Settings& s, int v) { imperfect(s, v, 64); });
    for (const int wrong : {16, 96, 512}) {
        EXPECT_THAT(refusal([&](Settings& s) { imperfect(s, 64, wrong); }),
                    AllOf(HasSubstr("--soft-shadow-size"), HasSubstr("power of two from 32 to 256")));
    }
    EXPECT_EQ(refusal([&](Settings& s) { imperfect(s, 0, 0); }), "") << "automatic";
    expect_range("--convolution-order", 1, 16, [](Settings& s, int v) { s.convolution_order = v; });
    const auto convolved = [](Settings& s) {
        s.direct_shadows = DirectShadows::convolution;
        s.soft_shadow_size = 4096;
    };
    EXPECT_THAT(refusal(convolved), HasSubstr("2048 at most"));
    expect_range("--soft-shadow-size", 2, 16384, [](Settings& s, int v) { s.soft_shadow_size = v; });
    EXPECT_THAT(refusal([](Settings& s) { s.rsm_size = 1; }), HasSubstr("--rsm-size is 1"));
    EXPECT_EQ(refusal([](Settings& s) { s.rsm_size = 0; }), "") << "automatic";
}

TEST(SettingsRefusal, MapSizesArePowersOfTwo) {
    for (const int wrong : {-64, 0, 16, 33, 96, 255, 512}) {
        EXPECT_THAT(refusal([&](Settings& s) { s.ism_size = wrong; }),
                    AllOf(HasSubstr("--ism-size"), HasSubstr("power of two from 32 to 256")))
            << wrong;
    }
    for (const int right : {32, 64, 128, 256}) {
        EXPECT_EQ(refusal([&](Settings& s) { s.ism_size = right; }), "");
    }
}

TEST(SettingsRefusal, InterleaveIsOneOfFive) {
    for (const int wrong : {-1, 0, 3, 5, 12, 32}) {
        EXPECT_THAT(refusal([&](Settings& s) { s.interleave = wrong; }), HasSubstr("1, 2, 4, 8 or 16"))
            << wrong;
    }
    for (const int right : {1, 2, 4, 8, 16}) {
        EXPECT_EQ(refusal([&](Settings& s) { s.interleave = right; }), "");
    }
}

TEST(SettingsRefusal, ThresholdsArePartsOfTheScenesExtent) {
    for (const float wrong : {-0.1F, 1.1F, std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_THAT(refusal([&](Settings& s) { s.pull_threshold = wrong; }), HasSubstr("--pull-threshold"));
        EXPECT_THAT(refusal([&](Settings& s) { s.push_threshold = wrong; }), HasSubstr("--push-threshold"));
    }
}

TEST(SettingsRefusal, ShownLightAndBounceAreThere) {
    const auto shown = [](int vpl, int bounce) {
        return refusal([&](Settings& s) {
            s.vpls = 20;  // in 4 x 4 subsets: 32
            s.bounce_vpls = 16;
            s.bounces = 2;
            s.shown_vpl = vpl;
            s.shown_bounce = bounce;
        });
    };
    EXPECT_EQ(shown(-1, 0), "");
    EXPECT_EQ(shown(31, 1), "");
    EXPECT_THAT(shown(32, 0), AllOf(HasSubstr("--vpl is 32"), HasSubstr("to 31")));
    EXPECT_THAT(shown(16, 2), HasSubstr("to 15"));
    EXPECT_THAT(shown(0, 3), HasSubstr("--bounce is 3"));
}

TEST(LimitsRefusal, AnAtlasThatTheDriverCannotHoldNamesWhatToLower) {
    Settings settings{.vpls = 4096, .ism_size = 256};  // 64 x 64 maps: 16,384 texels
    EXPECT_EQ(limits_refusal(settings, {.texture_size = 16384}), "");
    const std::string sentence = limits_refusal(settings, {.texture_size = 8192});
    EXPECT_THAT(sentence, AllOf(HasSubstr("16384 texels"), HasSubstr("lower --vpls to 1024"),
                                HasSubstr("--ism-size to 128")));
    // What it advises is let through.
    EXPECT_EQ(limits_refusal({.vpls = 1024, .ism_size = 256}, {.texture_size = 8192}), "");
    EXPECT_EQ(limits_refusal({.vpls = 4096, .ism_size = 128}, {.texture_size = 8192}), "");
    settings.visibility = Visibility::none;
    EXPECT_EQ(limits_refusal(settings, {.texture_size = 8192}), "") << "no maps";
    settings = {.bounces = 2, .bounce_vpls = 4096, .ism_size = 256};
    EXPECT_THAT(limits_refusal(settings, {.texture_size = 8192}), HasSubstr("lower --bounce-vpls to 1024"));
    settings.bounces = 1;
    EXPECT_EQ(limits_refusal(settings, {.texture_size = 8192}), "") << "no further bounce, no further maps";
    settings = {.technique = Technique::direct, .world_vpls = 4096, .ism_size = 256};
    EXPECT_THAT(limits_refusal(settings, {.texture_size = 8192}), HasSubstr("lower --world-vpls to 1024"));
    settings.world_vpls = 0;
    EXPECT_EQ(limits_refusal(settings, {.texture_size = 8192}), "");
}

TEST(LimitsRefusal, MapsOfLights) {
    EXPECT_THAT(limits_refusal({.shadow_size = 16384}, {.texture_size = 8192}), HasSubstr("--shadow-size"));
    EXPECT_THAT(limits_refusal({.rsm_size = 16384}, {.texture_size = 8192}), HasSubstr("--rsm-size"));
    EXPECT_EQ(limits_refusal({.technique = Technique::direct, .rsm_size = 16384}, {.texture_size = 8192}),
              "");
}

TEST(LimitsRefusal, ImperfectMapsOfPlacesMustFitWithTwoAPlace) {
    Settings s{.technique = Technique::direct, .world_vpls = 0, .emitter_vpls = 0};
    s.direct_shadows = DirectShadows::ism;
    s.shadow_samples = 512;
    s.soft_shadow_size = 256;
    EXPECT_EQ(limits_refusal(s, {.texture_size = 8192}), "");
    EXPECT_THAT(limits_refusal(s, {.texture_size = 4096}),
                AllOf(HasSubstr("--shadow-samples 512"), HasSubstr("8192 texels wide")));
    s.direct_shadows = DirectShadows::vpl;
    EXPECT_EQ(limits_refusal(s, {.texture_size = 4096}), "");
}

TEST(LayerRefusal, SaysWhyALayerIsNotThere) {
    const auto why = [](Settings settings, Show show) {
        settings.show = show;
        return layer_refusal(settings);
    };
    for (const auto& [name, show] : setting_names<Show>()) {
        const bool there = show == Show::shaded || show == Show::direct || show == Show::motion;
        EXPECT_EQ(why({.technique = Technique::direct}, show).empty(), there) << name;
    }
    EXPECT_EQ(why({.technique = Technique::rsm}, Show::interpolation), "");
    EXPECT_THAT(why({.technique = Technique::rsm, .interpolate = false}, Show::interpolation),
                HasSubstr("off"));
    EXPECT_THAT(why({.technique = Technique::ism}, Show::interpolation), HasSubstr("rsm"));
    EXPECT_THAT(why({.technique = Technique::rsm}, Show::vpls), HasSubstr("technique rsm"));
    EXPECT_EQ(why({}, Show::vpls), "");
    EXPECT_EQ(why({}, Show::ism), "");
    EXPECT_THAT(why({.visibility = Visibility::none}, Show::ism), HasSubstr("visibility none"));
    EXPECT_THAT(why({.splat = Splat::disks}, Show::ism_splats), HasSubstr("disks"));
    EXPECT_EQ(why({.splat = Splat::compute}, Show::ism_splats), "");
    EXPECT_THAT(why({.interleave = 1}, Show::unblurred), HasSubstr("interleave 1"));
    EXPECT_THAT(why({.near_field = true}, Show::removed), HasSubstr("near field"));
    EXPECT_EQ(why({.bounces = 2, .near_field = true}, Show::removed), "");
    EXPECT_EQ(why({.near_field = false}, Show::removed), "");
}

TEST(SettingNames, NameEveryValueOnce) {
    EXPECT_EQ(name_of(Show::vpl_visibility), "vpl-visibility");
    EXPECT_EQ(setting_names<Show>().size(), static_cast<size_t>(Show::avg) + 1);
    for (const auto& [name, show] : setting_names<Show>()) {
        EXPECT_EQ(name_of(show), name);
    }
}

}  // namespace
}  // namespace bounce
