// SPDX-License-Identifier: Apache-2.0
#include "image/view_transform.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/process.h"
#include "image/color_config.h"
#include "image/image_io.h"
#include "image/srgb.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;

Image greys(const std::vector<float>& values) {
    Image image(static_cast<int>(values.size()), 1);
    for (size_t i = 0; i < values.size(); ++i) {
        image.rgb[3 * i] = image.rgb[3 * i + 1] = image.rgb[3 * i + 2] = values[i];
    }
    return image;
}

TEST(Srgb, KnownValuesAndRoundTrip) {
    EXPECT_FLOAT_EQ(srgb_from_linear(0.0F), 0.0F);
    EXPECT_FLOAT_EQ(srgb_from_linear(0.002F), 0.02584F);    // 12.92 * 0.002
    EXPECT_NEAR(srgb_from_linear(0.18F), 0.461356F, 1e-5);  // 1.055 * 0.18^(1/2.4) - 0.055
    EXPECT_NEAR(srgb_from_linear(1.0F), 1.0F, 1e-6);
    for (int i = 0; i <= 255; ++i) {
        const float encoded = static_cast<float>(i) / 255.0F;
        EXPECT_NEAR(srgb_from_linear(linear_from_srgb(encoded)), encoded, 1e-6);
    }
}

TEST(ViewTransform, StandardIsExposureCurveGamma) {
    const Image scene = greys({0.0F, 0.18F, 0.5F, 1.0F, 7.0F, -1.0F});
    const Image plain = to_display(scene, {});
    EXPECT_NEAR(plain.rgb[3], 0.461356F, 1e-5);
    EXPECT_NEAR(plain.rgb[6], 0.735357F, 1e-5);
    EXPECT_FLOAT_EQ(plain.rgb[9], 1.0F);
    EXPECT_FLOAT_EQ(plain.rgb[12], 1.0F);
    EXPECT_FLOAT_EQ(plain.rgb[15], 0.0F);

    ViewTransform view;
    view.exposure = 1.0F;  // 0.5 becomes 1, 0.18 becomes 0.36
    view.gamma = 2.0F;     // the square root of the encoded value
    const Image brighter = to_display(scene, view);
    EXPECT_NEAR(brighter.rgb[3], std::sqrt(srgb_from_linear(0.36F)), 1e-6);
    EXPECT_FLOAT_EQ(brighter.rgb[6], 1.0F);
}

// Sets a variable of the environment for as long as it lives.
class Variable {
  public:
    Variable(const char* name, const std::string& value) : name_(name) {
        if (const char* before = std::getenv(name)) {
            before_ = before;
        }
        setenv(name, value.c_str(), 1);
    }
    ~Variable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    const char* name_;
    std::optional<std::string> before_;
};

TEST(ViewTransform, FallsBackToStandardWithoutAConfiguration) {
    const TemporaryFolder folder;
    const Variable config("OCIO", (folder / "missing.ocio").string());
    const Variable blender("BLENDER", (folder / "no blender").string());
    const ViewTransform filmic{.view_transform = "Filmic", .exposure = 0.5F, .gamma = 1.2F};
    testing::internal::CaptureStderr();
    EXPECT_EQ(to_display(greys({0.18F}), filmic).rgb,
              to_display(greys({0.18F}), {.exposure = 0.5F, .gamma = 1.2F}).rgb);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("missing.ocio"), std::string::npos) << said;
    EXPECT_NE(said.find("Filmic"), std::string::npos) << said;
}

TEST(ViewTransform, AConfigurationThatCannotBeReadIsReplacedByTheNext) {
    if (!find_color_config()) {
        GTEST_SKIP() << "no OpenColorIO configuration of Blender here";
    }
    const ViewTransform filmic{.view_transform = "Filmic"};
    const Image expected = to_display(greys({0.18F}), filmic);
    const TemporaryFolder folder;
    std::ofstream(folder / "broken.ocio") << "this is no configuration";
    for (const char* name : {"broken.ocio", "missing.ocio"}) {
        const Variable broken("OCIO", (folder / name).string());
        testing::internal::CaptureStderr();
        const Image shown = to_display(greys({0.18F}), filmic);
        const std::string said = testing::internal::GetCapturedStderr();
        EXPECT_EQ(shown.rgb, expected.rgb);
        EXPECT_NE(said.find(name), std::string::npos) << said;
        EXPECT_NE(said.find("is used instead"), std::string::npos) << said;
    }
}

TEST(ViewTransform, NamesThatAreNotThereAreToldAndReplaced) {
    if (!find_color_config()) {
        GTEST_SKIP() << "no OpenColorIO configuration of Blender here";
    }
    struct Case {
        ViewTransform asked;
        ViewTransform shown;
        const char* named;
    };
    const Case cases[] = {
        {{.view_transform = "Kodachrome", .exposure = 1.0F}, {.exposure = 1.0F}, "Kodachrome"},
        {{.view_transform = "Filmic", .look = "Bleach", .gamma = 1.5F},
         {.view_transform = "Filmic", .gamma = 1.5F},
         "Bleach"},
        {{.display_device = "Cathode", .view_transform = "Filmic"}, {.view_transform = "Filmic"}, "Cathode"},
    };
    for (const Case& one : cases) {
        EXPECT_NE(unknown_name(one.asked).find(one.named), std::string::npos);
        EXPECT_EQ(unknown_name(one.shown), "");
        testing::internal::CaptureStderr();
        const Image shown = to_display(greys({0.05F, 0.18F, 0.9F}), one.asked);
        const std::string said = testing::internal::GetCapturedStderr();
        EXPECT_NE(said.find(one.named), std::string::npos) << said;
        EXPECT_EQ(shown.rgb, to_display(greys({0.05F, 0.18F, 0.9F}), one.shown).rgb);
    }
    EXPECT_NE(unknown_name({.view_transform = "Kodachrome"}).find("Standard, Filmic"), std::string::npos)
        << "those that there are";
}

TEST(ViewTransform, FilmicIsMonotone) {
    if (!find_color_config()) {
        GTEST_SKIP() << "no OpenColorIO configuration of Blender here";
    }
    std::vector<float> ramp;
    for (int i = -40; i <= 20; ++i) {
        ramp.push_back(std::exp2(static_cast<float>(i) / 4.0F));
    }
    ViewTransform filmic;
    filmic.view_transform = "Filmic";
    const Image display = to_display(greys(ramp), filmic);
    for (size_t i = 1; i < ramp.size(); ++i) {
        EXPECT_GE(display.rgb[3 * i], display.rgb[3 * (i - 1)]) << "at " << ramp[i];
    }
    EXPECT_LT(display.rgb[0], 0.05F);
    EXPECT_GT(display.rgb[3 * (ramp.size() - 1)], 0.95F);
}

// Blender's own pixels are the reference: a picture with these values is saved by Blender through each
// transform, 8 bits, and may differ from ours by one step of rounding.
TEST(ViewTransform, AgreesWithBlender) {
    const auto blender = find_program(std::getenv("BLENDER") != nullptr ? std::getenv("BLENDER") : "blender");
    if (!blender || !color_config_of_blender(*blender)) {
        GTEST_SKIP() << "Blender is not installed here";
    }
    const TemporaryFolder folder;
    Image scene(48, 3);  // a grey ramp over 12 stops, and two coloured ones
    for (int x = 0; x < 48; ++x) {
        const float value = std::exp2(static_cast<float>(x) / 4.0F - 8.0F);
        const float rows[3][3] = {{1, 1, 1}, {1, .25F, .05F}, {.1F, .4F, 1}};
        for (int y = 0; y < 3; ++y) {
            for (size_t channel = 0; channel < 3; ++channel) {
                scene.rgb[scene.offset(x, y) + channel] = value * rows[y][channel];
            }
        }
    }
    write_image(folder / "scene.exr", scene);
    scene = read_image(folder / "scene.exr");  // as half, which is what Blender sees

    struct Case {
        ViewTransform view;
        std::string name;
    };
    const std::vector<Case> cases{
        {{"sRGB", "Standard", "None", 0.0F, 1.0F}, "standard"},
        {{"sRGB", "Standard", "None", -1.5F, 1.8F}, "standard_adjusted"},
        {{"sRGB", "Filmic", "None", 0.0F, 1.0F}, "filmic"},
        {{"sRGB", "Filmic", "High Contrast", 0.5F, 1.2F}, "filmic_high_contrast"},
        {{"sRGB", "Filmic Log", "None", 0.0F, 1.0F}, "filmic_log"},
        {{"sRGB", "Raw", "None", 0.0F, 1.0F}, "raw"},
        {{"sRGB", "False Color", "None", 0.0F, 1.0F}, "false_color"},
    };
    std::string script = fmt::format(
        "import bpy\nscene = bpy.context.scene\nimage = bpy.data.images.load('{0}/scene.exr')\n"
        "image.colorspace_settings.name = 'Linear'\nscene.render.image_settings.file_format = 'PNG'\n"
        "scene.render.image_settings.color_mode = 'RGB'\nscene.render.dither_intensity = 0\n",
        folder.path().string());
    for (const Case& item : cases) {
        script += fmt::format(
            "v = scene.view_settings\nv.view_transform = '{}'\nv.look = '{}'\nv.exposure = {}\nv.gamma = {}\n"
            "image.save_render('{}/{}.png', scene=scene)\n",
            item.view.view_transform, item.view.look, item.view.exposure, item.view.gamma,
            folder.path().string(), item.name);
    }
    std::ofstream(folder / "save.py") << script;
    const ProcessResult run = run_process({blender->string(), "-b", "--factory-startup", "--python-exit-code",
                                           "9", "-P", (folder / "save.py").string()});
    ASSERT_EQ(run.exit_code, 0) << run.output;

    for (const Case& item : cases) {
        const Image expected = read_image(folder / (item.name + ".png"));
        const Image ours = to_display(scene, item.view);
        ASSERT_EQ(ours.rgb.size(), expected.rgb.size());
        for (size_t i = 0; i < ours.rgb.size(); ++i) {
            EXPECT_NEAR(ours.rgb[i] * 255.0F, expected.rgb[i] * 255.0F, 1.0F)
                << item.name << ", scene-linear value " << scene.rgb[i];
        }
    }
}

}  // namespace
}  // namespace bounce
