// SPDX-License-Identifier: Apache-2.0
#include "evaluate/given_reference.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

class GivenReferenceTest : public testing::Test {
  protected:
    GivenReferenceTest() {
        evaluation_.scene = "room.blend";
        evaluation_.scene_hash = "hash";
        evaluation_.reference_spp = 512;
        evaluation_.bounces = 2;
        reference_.frame = 12;
        reference_.image = Image(8, 4);
        std::fill(reference_.image.rgb.begin(), reference_.image.rgb.end(), 0.3F);
        reference_.noise_floor = 1.25e-5;
        reference_.seconds = 33.5;
        write(reference_attributes(evaluation_, reference_));
    }

    void write(const ImageAttributes& attributes) const {
        write_image(path_, reference_.image, attributes, ExrValues::full);
    }

    [[nodiscard]] std::string refusal(const ReferenceKey& key) const {
        try {
            (void)read_given_reference(path_, key);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::input_refused);
            return error.what();
        }
        return "";
    }

    TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "reference.0012.exr";
    Evaluation evaluation_;
    Reference reference_;
    ReferenceKey key_{"hash", 12, 8, 4, 1024, 2, "", ""};
};

TEST_F(GivenReferenceTest, IsReadBackWithWhatItSays) {
    const GivenReference given = read_given_reference(path_, key_);
    EXPECT_EQ(given.reference.image.rgb, reference_.image.rgb);
    EXPECT_EQ(given.reference.noise_floor, 1.25e-5);
    EXPECT_EQ(given.reference.seconds, 33.5);
    EXPECT_EQ(given.spp, 512) << "its own, not those asked for";
}

TEST_F(GivenReferenceTest, OfSomethingElseIsRefused) {
    ReferenceKey key = key_;
    key.scene_hash = "other";
    EXPECT_THAT(refusal(key), HasSubstr("another scene, room.blend"));
    key = key_;
    key.frame = 1;
    EXPECT_THAT(refusal(key), HasSubstr("of frame 12, not 1"));
    key = key_;
    key.width = 16;
    EXPECT_THAT(refusal(key), HasSubstr("8 x 4, not 16 x 4; give --size 8x4"));
    key = key_;
    key.bounces = 1;
    EXPECT_THAT(refusal(key), HasSubstr("give --bounces 2"));
}

TEST_F(GivenReferenceTest, ThatDoesNotSayOfWhatItIsIsRefused) {
    write({});
    EXPECT_THAT(refusal(key_), HasSubstr("does not say its scene_sha256"));
    ImageAttributes attributes = reference_attributes(evaluation_, reference_);
    attributes["bounce:frame"] = "twelve";
    write(attributes);
    EXPECT_THAT(refusal(key_), HasSubstr("its frame is \"twelve\""));
    std::filesystem::remove(path_);
    EXPECT_THAT(refusal(key_), HasSubstr("there is no such file"));
}

}  // namespace
}  // namespace bounce
