// SPDX-License-Identifier: Apache-2.0
//
// What the window shows is what image files hold: the display program against to_display().
#include "viewer/display.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "gl/context.h"
#include "gl/framebuffer.h"
#include "image/color_config.h"
#include "image/image.h"

namespace bounce::viewer {
namespace {

constexpr int k_width = 256;
constexpr int k_height = 128;

// Colours from far below to far above what a screen shows, grey ones and saturated ones, and what a
// broken pixel may hold.
Image colors() {
    Image image(k_width, k_height);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> stops(-14.0F, 9.0F);
    std::uniform_real_distribution<float> tint(-0.5F, 0.5F);
    for (size_t pixel = 0; pixel < image.rgb.size() / 3; ++pixel) {
        const float grey = stops(random);
        const int kind = static_cast<int>(pixel % 3);
        for (size_t channel = 0; channel < 3; ++channel) {
            const float stop = kind == 0 ? grey : kind == 1 ? grey + tint(random) : stops(random);
            image.rgb[pixel * 3 + channel] = std::exp2(stop);
        }
    }
    const float odd[] = {0.0F, -1.0F, 1e30F, 0.5F, -1e30F, 65504.0F};
    std::copy(std::begin(odd), std::end(odd), image.rgb.begin());
    return image;
}

gl::Texture upload(const Image& image) {
    std::vector<float> rgba;
    for (int y = image.height - 1; y >= 0; --y) {  // the renderer's textures have the bottom row first
        for (int x = 0; x < image.width; ++x) {
            const float* rgb = &image.rgb[image.offset(x, y)];
            rgba.insert(rgba.end(), {rgb[0], rgb[1], rgb[2], 1.0F});
        }
    }
    gl::Texture texture("colors", {.format = GL_RGBA32F, .width = image.width, .height = image.height});
    glTextureSubImage2D(texture.id(), 0, 0, 0, image.width, image.height, GL_RGBA, GL_FLOAT, rgba.data());
    return texture;
}

// In floats, so that the error itself is seen and not its rounding to 8 bits.
Image displayed(const gl::Texture& color, const ViewTransform& view, int width, int height) {
    const gl::Texture target("target", {.format = GL_RGBA32F, .width = width, .height = height});
    const gl::Framebuffer framebuffer("target", {{&target}});
    framebuffer.bind();
    Display display;
    display.draw(color, view, width, height);
    const auto row = static_cast<size_t>(width);
    const auto rows = static_cast<size_t>(height);
    std::vector<float> rgba(row * rows * 4);
    glGetTextureImage(target.id(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(rgba.size() * sizeof(float)),
                      rgba.data());
    Image image(width, height);
    for (size_t y = 0; y < rows; ++y) {
        for (size_t x = 0; x < row; ++x) {
            std::copy_n(&rgba[((rows - 1 - y) * row + x) * 4], 3, &image.rgb[(y * row + x) * 3]);
        }
    }
    return image;
}

struct Difference {
    float largest = 0.0F;
    double mean = 0.0;
};

Difference difference(const Image& a, const Image& b) {
    Difference out;
    for (size_t i = 0; i < a.rgb.size(); ++i) {
        const float one = std::abs(a.rgb[i] - b.rgb[i]);
        // A NaN is as wrong as can be.
        out.largest = std::isnan(one) ? 1.0F : std::max(out.largest, one);
        out.mean += static_cast<double>(one) / static_cast<double>(a.rgb.size());
    }
    return out;
}

class DisplayTest : public testing::Test {
  protected:
    DisplayTest() { gl::initialise_current_context(); }
    gl::HeadlessContext context_;
};

TEST_F(DisplayTest, StandardIsExact) {
    const Image image = colors();
    const gl::Texture texture = upload(image);
    for (const ViewTransform& view : {ViewTransform{}, ViewTransform{.exposure = -1.5F, .gamma = 1.4F}}) {
        const Difference found =
            difference(displayed(texture, view, k_width, k_height), to_display(image, view));
        // pow() of a GPU and of the C library differ in the last bits; a few thousandths of an 8-bit step
        // are far above that and far below what can be seen.
        EXPECT_LT(found.largest * 255.0F, 4e-3F);
    }
}

TEST_F(DisplayTest, NotANumberIsBlackAsInAnEightBitFile) {
    Image image(4, 4);
    image.rgb.assign(image.rgb.size(), std::numeric_limits<float>::quiet_NaN());
    const Image shown = displayed(upload(image), {}, 4, 4);
    for (const float value : shown.rgb) {
        EXPECT_EQ(value, 0.0F);
    }
}

TEST_F(DisplayTest, APictureOfHalfTheSizeIsStretchedOverTheWindow) {
    Image image(4, 4);
    for (size_t i = 0; i < image.rgb.size(); ++i) {
        image.rgb[i] = i < image.rgb.size() / 2 ? 1.0F : 0.0F;  // upper half white
    }
    const Image shown = displayed(upload(image), {}, 8, 8);
    EXPECT_NEAR(shown.rgb[shown.offset(0, 0)], 1.0F, 1e-5F);
    EXPECT_NEAR(shown.rgb[shown.offset(7, 2)], 1.0F, 1e-5F);
    EXPECT_NEAR(shown.rgb[shown.offset(0, 7)], 0.0F, 1e-5F);
    EXPECT_NEAR(shown.rgb[shown.offset(7, 5)], 0.0F, 1e-5F);
}

// A view transform and the most that any colour may be off, in steps of 8 bits.
struct Case {
    const char* name;
    ViewTransform view;
    float largest;
};

// Else GoogleTest prints, and names the test by, the bytes of its pointers.
void PrintTo(const Case& one, std::ostream* out) {
    *out << one.name;
}

class ViewTransformTest : public DisplayTest, public testing::WithParamInterface<Case> {};

TEST_P(ViewTransformTest, DiffersLittleFromWhatFilesHold) {
    if (!find_color_config()) {
        GTEST_SKIP() << "no OpenColorIO configuration of Blender on this machine";
    }
    const auto& [name, view, largest] = GetParam();
    const Image image = colors();
    const Difference found =
        difference(displayed(upload(image), view, k_width, k_height), to_display(image, view));
    EXPECT_LT(found.largest * 255.0F, largest);
    // Pictures as a whole are far nearer; the largest errors sit in the few cells where a channel is cut
    // off at 0 or 1, which a lattice rounds.
    EXPECT_LT(found.mean * 255.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(
    Blender, ViewTransformTest,
    testing::Values(Case{"Filmic", {.view_transform = "Filmic"}, 2.0F},
                    Case{"FilmicContrast",
                         {.view_transform = "Filmic", .look = "Very High Contrast", .exposure = 1.0F},
                         2.0F},
                    // Gamma steepens the curve at black, and its errors with it.
                    Case{"FilmicGamma", {.view_transform = "Filmic", .gamma = 1.8F}, 4.0F},
                    Case{"FilmicLog", {.view_transform = "Filmic Log"}, 2.0F},
                    // Straight lines over a lattice that is even in stops, cut off at 1.
                    Case{"Raw", {.view_transform = "Raw"}, 5.0F}),
    [](const testing::TestParamInfo<Case>& one) { return one.param.name; });

}  // namespace
}  // namespace bounce::viewer
