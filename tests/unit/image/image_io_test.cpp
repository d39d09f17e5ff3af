// SPDX-License-Identifier: Apache-2.0
#include "image/image_io.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "file_size_limit.h"
#include "temporary_folder.h"

// libpng leaves OpenImageIO 2.4's reader of a cut PNG by longjmp, past the destructor of a string.
// NOLINTNEXTLINE: the sanitizer looks for this name
extern "C" const char* __lsan_default_suppressions() {
    return "leak:OpenImageIO_v2_4::ImageInput::geterror";
}

namespace bounce {
namespace {

using test::TemporaryFolder;
namespace fs = std::filesystem;

Image two_by_two(const std::vector<float>& rgb) {
    Image image(2, 2);
    image.rgb = rgb;
    return image;
}

std::string bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

void write_raw(const fs::path& path, int channels, const std::vector<float>& values, int width, int height,
               const std::vector<std::string>& names = {}) {
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::FLOAT);
    if (!names.empty()) {
        spec.channelnames = names;
    }
    const auto output = OIIO::ImageOutput::create(path.string());
    ASSERT_TRUE(output && output->open(path.string(), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    output->close();
}

// The refusal's message; fails the test where the file is read.
std::string refusal(const fs::path& path) {
    try {
        (void)read_image(path);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos)
            << "not one sentence: " << error.what();
        return error.what();
    }
    ADD_FAILURE() << path << " was read";
    return {};
}

TEST(ImageIo, ExrKeepsHalfFloatsExactly) {
    const TemporaryFolder folder;
    // All representable as half: fractions of powers of two, a large, a denormal and a negative value.
    const Image image = two_by_two({0.0F, 0.5F, 1.0F, 2.25F, 1024.0F, 65504.0F, -0.125F, 5.9604645e-8F, 3.0F,
                                    0.333251953125F, 7.0F, 0.0009765625F});
    write_image(folder / "a.exr", image);
    const Image read = read_image(folder / "a.exr");
    EXPECT_EQ(read.width, 2);
    EXPECT_EQ(read.height, 2);
    EXPECT_EQ(read.rgb, image.rgb);
}

TEST(ImageIo, ExrRoundsToTheNearestHalfAndClipsWhatHalfCannotHold) {
    const TemporaryFolder folder;
    const float infinity = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Image image =
        two_by_two({0.1F, 1e9F, -1e9F, infinity, nan, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F});
    write_image(folder / "a.exr", image);
    const Image read = read_image(folder / "a.exr");
    EXPECT_EQ(read.rgb[0], 0.0999755859375F);  // the half nearest to 0.1
    EXPECT_EQ(read.rgb[1], 65504.0F);
    EXPECT_EQ(read.rgb[2], -65504.0F);
    EXPECT_EQ(read.rgb[3], infinity);
    EXPECT_TRUE(std::isnan(read.rgb[4]));
}

TEST(ImageIo, ExrKeepsWholeFloatsWhereAskedTo) {
    const TemporaryFolder folder;
    // Neither the digits nor the range of these fit a half float.
    const Image image = two_by_two({1.2345678F, -123.456F, 1e6F, 3e-7F, 0, 1, 2, 3, 4, 5, 6, 7});
    write_image(folder / "a.exr", image, {}, ExrValues::full);
    EXPECT_EQ(read_image(folder / "a.exr").rgb, image.rgb);
}

TEST(ImageIo, ExrCarriesAttributes) {
    const TemporaryFolder folder;
    write_image(folder / "a.exr", Image(2, 2), {{"bounce:scene", "cornell.glb"}, {"bounce:frame", "12"}});
    const auto input = OIIO::ImageInput::open((folder / "a.exr").string());
    ASSERT_TRUE(input);
    EXPECT_EQ(input->spec().get_string_attribute("bounce:scene"), "cornell.glb");
    EXPECT_EQ(input->spec().get_string_attribute("bounce:frame"), "12");
    EXPECT_EQ(input->spec().format, OIIO::TypeDesc::HALF);
}

TEST(ImageIo, PngRoundsToEightBitsWithoutACurve) {
    const TemporaryFolder folder;
    // k/255 for every third k must come back as k exactly; halfway values round up.
    Image image(86, 1);
    for (int x = 0; x < 86; ++x) {
        for (size_t channel = 0; channel < 3; ++channel) {
            image.rgb[image.offset(x, 0) + channel] = static_cast<float>(x * 3) / 255.0F;
        }
    }
    write_image(folder / "ramp.png", image);
    EXPECT_THAT(read_image(folder / "ramp.png").rgb, testing::Pointwise(testing::FloatEq(), image.rgb));

    const Image rounding =
        two_by_two({0.4F / 255, 0.6F / 255, 1.5F / 255, 254.4F / 255, 254.6F / 255, 2.0F, -1.0F,
                    std::numeric_limits<float>::quiet_NaN(), 0.5F, 0.0F, 1.0F, 0.0F});
    write_image(folder / "rounding.png", rounding);
    const Image read = read_image(folder / "rounding.png");
    const std::vector<int> expected{0, 1, 2, 254, 255, 255, 0, 0, 128, 0, 255, 0};
    for (size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(std::lround(read.rgb[i] * 255.0F), expected[i]) << "value " << i;
    }
}

TEST(ImageIo, RowsRunFromTopToBottom) {
    const TemporaryFolder folder;
    Image image(1, 3);
    image.rgb = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (const char* name : {"a.exr", "a.png", "a.hdr", "a.tif", "a.tga"}) {
        write_image(folder / name, image);
        EXPECT_EQ(read_image(folder / name).rgb, image.rgb) << name;
    }
}

TEST(ImageIo, TheSamePixelsGiveTheSameBytes) {
    const TemporaryFolder folder;
    const Image image = two_by_two({.1F, .2F, .3F, .4F, .5F, .6F, .7F, .8F, .9F, .1F, .2F, .3F});
    for (const char* extension : {".exr", ".png"}) {
        write_image(folder / (std::string("a") + extension), image);
        write_image(folder / (std::string("b") + extension), image);
        EXPECT_EQ(bytes_of(folder / (std::string("a") + extension)),
                  bytes_of(folder / (std::string("b") + extension)));
        EXPECT_EQ(bytes_of(folder / (std::string("a") + extension)).find("DateTime"), std::string::npos)
            << "a date would change the file from run to run";
    }
    // Two files of one second could hold the same time of day.
    EXPECT_NE(bytes_of(folder / "a.exr").find("1970:01:01 00:00:00"), std::string::npos);
}

TEST(ImageIo, AFailedWriteLeavesWhatWasThere) {
    const TemporaryFolder folder;
    write_image(folder / "a.exr", Image(2, 2));
    const std::string before = bytes_of(folder / "a.exr");
    EXPECT_THROW(write_image(folder / "a.nosuchformat", Image(2, 2)), Error);
    EXPECT_THROW(write_image(folder / "a.exr" / "inside_a_file.exr", Image(2, 2)), Error);
    EXPECT_EQ(bytes_of(folder / "a.exr"), before);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator{}), 1)
        << "a temporary file stayed behind";
}

// The small ones lie in the writers' buffers until they are closed, where OpenImageIO does not look for
// errors.
TEST(ImageIo, AFullDiskIsAnErrorAndLeavesWhatWasThere) {
    const TemporaryFolder folder;
    Image large(64, 64);
    for (size_t i = 0; i < large.rgb.size(); ++i) {
        large.rgb[i] = static_cast<float>(i * 7919U % 10007U) / 10007.0F;
    }
    for (const char* extension : {".exr", ".png", ".hdr", ".tif", ".tga", ".jpg"}) {
        const fs::path path = folder / (std::string("a") + extension);
        for (const Image& image : {Image(2, 2), large}) {
            write_image(path, image);
            const std::string before = bytes_of(path);
            const test::FileSizeLimit limit(before.size() - 1);
            EXPECT_THROW(write_image(path, image), Error) << path << ' ' << image.width;
            EXPECT_EQ(bytes_of(path), before) << path;
        }
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator{}), 6);
}

TEST(ImageIo, MakesMissingFolders) {
    const TemporaryFolder folder;
    write_image(folder / "x/y/a.png", Image(1, 1));
    EXPECT_TRUE(fs::exists(folder / "x/y/a.png"));
}

TEST(ImageIo, RefusesWhatIsNoImage) {
    const TemporaryFolder folder;
    EXPECT_THAT(refusal(folder / "missing.exr"), testing::HasSubstr("missing.exr: there is no such file"));
    EXPECT_THAT(refusal(folder.path()), testing::HasSubstr("it is not a file"));
    std::ofstream(folder / "text.exr") << "this is no EXR";
    EXPECT_THAT(refusal(folder / "text.exr"), testing::HasSubstr("text.exr"));
    std::ofstream(folder / "empty.png").flush();
    EXPECT_THAT(refusal(folder / "empty.png"), testing::HasSubstr("empty.png"));

    write_image(folder / "whole.png", Image(64, 64));
    const std::string whole = bytes_of(folder / "whole.png");
    std::ofstream(folder / "cut.png", std::ios::binary) << whole.substr(0, whole.size() / 2);
    EXPECT_THAT(refusal(folder / "cut.png"), testing::HasSubstr("cut.png"));
}

TEST(ImageIo, DropsOpaqueAlphaAndRefusesTheRest) {
    const TemporaryFolder folder;
    write_raw(folder / "opaque.exr", 4, {.25F, .5F, .75F, 1, 1, 2, 3, 1}, 2, 1);
    EXPECT_EQ(read_image(folder / "opaque.exr").rgb, (std::vector<float>{.25F, .5F, .75F, 1, 2, 3}));
    write_raw(folder / "veil.exr", 4, {.25F, .5F, .75F, 1, 1, 2, 3, .5F}, 2, 1);
    EXPECT_THAT(refusal(folder / "veil.exr"), testing::HasSubstr("its alpha is 0.5 at pixel (1, 0)"));
}

TEST(ImageIo, FindsChannelsByName) {
    const TemporaryFolder folder;
    write_raw(folder / "depth_first.exr", 4, {9, 1, 2, 3}, 1, 1, {"depth", "R", "G", "B"});
    EXPECT_EQ(read_image(folder / "depth_first.exr").rgb, (std::vector<float>{1, 2, 3}));
    write_raw(folder / "grey.exr", 1, {0.5F}, 1, 1, {"Y"});
    EXPECT_EQ(read_image(folder / "grey.exr").rgb, (std::vector<float>{.5F, .5F, .5F}));
    write_raw(folder / "normal.exr", 3, {1, 2, 3}, 1, 1, {"N.X", "N.Y", "N.Z"});
    EXPECT_THAT(refusal(folder / "normal.exr"), testing::HasSubstr("no channels named R, G and B"));
}

TEST(ImageIo, KnowsLinearFormats) {
    EXPECT_TRUE(is_scene_linear("a/b.exr"));
    EXPECT_TRUE(is_scene_linear("B.EXR"));
    EXPECT_TRUE(is_scene_linear("b.tif"));
    EXPECT_FALSE(is_scene_linear("b.png"));
    EXPECT_FALSE(is_scene_linear("b.jpg"));
    EXPECT_FALSE(is_scene_linear("exr"));
}

}  // namespace
}  // namespace bounce
