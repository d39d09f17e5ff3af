// SPDX-License-Identifier: Apache-2.0
#include "evaluate/given_reference.h"

#include <cmath>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "fake_programs.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

std::string refusal(const std::string& name, int frame, int width, int height, int bounces) {
    try {
        (void)load_given_reference(name, frame, width, height, bounces, "hash");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        return error.what();
    }
    return {};
}

TEST(GivenReference, TellsWhatItsHeaderSays) {
    const TemporaryFolder folder;
    Reference reference;
    reference.frame = 24;
    reference.image = Image(4, 2);
    reference.noise_floor = 1.25e-5;
    reference.seconds = 12.5;
    reference.spp = 512;
    write_image(folder / "ref.0024.exr", reference.image,
                reference_attributes(reference, "room.blend", "hash", 2));
    const std::string name = (folder / "ref.####.exr").string();
    const Reference read = load_given_reference(name, 24, 4, 2, 2, "hash");
    EXPECT_EQ(read.frame, 24);
    EXPECT_EQ(read.image.rgb, reference.image.rgb);
    EXPECT_EQ(read.noise_floor, 1.25e-5);
    EXPECT_EQ(read.seconds, 12.5);
    EXPECT_EQ(read.spp, 512);

    EXPECT_THAT(refusal(name, 24, 8, 2, 2), HasSubstr("is 4x2, the frames are 8x2"));
    EXPECT_THAT(refusal(name, 24, 4, 2, 1), HasSubstr("has 2 bounces"));
    EXPECT_THAT(refusal((folder / "ref.0024.exr").string(), 1, 4, 2, 2),
                HasSubstr("is of frame 24, not of frame 1"));
    EXPECT_THAT(refusal(name, 1, 4, 2, 2), HasSubstr("no such file"));
}

TEST(GivenReference, OfAnotherSceneIsRefused) {
    const TemporaryFolder folder;
    Reference reference;
    reference.image = Image(4, 2);
    write_image(folder / "ref.exr", reference.image,
                reference_attributes(reference, "room.blend", "other", 2));
    EXPECT_THAT(refusal((folder / "ref.exr").string(), 1, 4, 2, 2),
                HasSubstr("another scene or of another state of it: room.blend"));
}

TEST(GivenReference, AFinalRenderIsNone) {
    const TemporaryFolder folder;
    Reference reference;
    reference.image = Image(4, 2);
    write_image(folder / "final.exr", reference.image, final_attributes(reference, "room.blend", "hash"));
    EXPECT_THAT(refusal((folder / "final.exr").string(), 1, 4, 2, 2),
                HasSubstr("is the final render, by the scene's own light paths"));
}

TEST(GivenReference, OfAnotherProgramHasNoHeader) {
    const TemporaryFolder folder;
    test::write_constant(folder / "a.exr", 0.5F, 4, 2);
    testing::internal::CaptureStderr();
    const Reference read = load_given_reference((folder / "a.exr").string(), 7, 4, 2, 1, "hash");
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("does not say of which scene"));
    EXPECT_EQ(read.frame, 7);
    EXPECT_TRUE(std::isnan(read.noise_floor));
    EXPECT_EQ(read.spp, 0);
}

TEST(GivenReference, ADamagedOneIsRefused) {
    const TemporaryFolder folder;
    test::write_constant(folder / "nan.exr", std::numeric_limits<float>::quiet_NaN(), 4, 2);
    EXPECT_THAT(refusal((folder / "nan.exr").string(), 1, 4, 2, 1), HasSubstr("not numbers"));
    write_image(folder / "odd.exr", Image(4, 2), {{"bounce:frame", "one"}});
    EXPECT_THAT(refusal((folder / "odd.exr").string(), 1, 4, 2, 1), HasSubstr("'one', which cannot be"));
    for (const char* value : {"nan", "-1", "inf", "1e999", "0x1", "\x1b[31m\n"}) {
        write_image(folder / "odd.exr", Image(4, 2), {{"bounce:noise_floor_relmse", value}});
        const std::string sentence = refusal((folder / "odd.exr").string(), 1, 4, 2, 1);
        EXPECT_THAT(sentence, HasSubstr("which cannot be")) << value;
        EXPECT_EQ(sentence.find_first_of("\x1b\n"), std::string::npos) << "one line, whatever a header says";
    }
    test::write_constant(folder / "cut.exr", 0.5F, 4, 2);
    std::filesystem::resize_file(folder / "cut.exr", std::filesystem::file_size(folder / "cut.exr") - 20);
    EXPECT_THAT(refusal((folder / "cut.exr").string(), 1, 4, 2, 1), HasSubstr("cut.exr"));
    EXPECT_THAT(refusal(folder.path().string(), 1, 4, 2, 1), HasSubstr("it is not a file"));
    std::filesystem::create_symlink("/dev/zero", folder / "device.exr");
    EXPECT_THAT(refusal((folder / "device.exr").string(), 1, 4, 2, 1), HasSubstr("it is not a file"));
}

}  // namespace
}  // namespace bounce
