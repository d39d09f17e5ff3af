// SPDX-License-Identifier: Apache-2.0
#include "evaluate/scene_files.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

// The sentence with which a file of this JSON is refused; empty where it is not.
std::string refusal(const std::string& json) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a.gltf") << json;
    try {
        require_camera_and_light(folder / "a.gltf");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        return error.what();
    }
    return {};
}

TEST(RequireCameraAndLight, SaysWhatBlenderWouldLack) {
    EXPECT_THAT(refusal(R"({})"), HasSubstr("has no camera"));
    EXPECT_THAT(refusal(R"({"nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}]})"),
                HasSubstr("has no camera"));
    EXPECT_THAT(refusal(R"({"nodes": [{"camera": 0}]})"), HasSubstr("has no light"));
}

TEST(RequireCameraAndLight, TakesWhatBothCanShow) {
    EXPECT_EQ(refusal(R"({"nodes": [{"camera": 0}, {"extensions": {"KHR_lights_punctual": {"light": 0}}}]})"),
              "");
    EXPECT_EQ(refusal(R"({"nodes": [{"camera": 0}], "extensionsUsed": ["BOUNCE_scene"]})"), "");
    EXPECT_EQ(refusal(R"({"nodes": [{"camera": 0}], "extensionsUsed": ["KHR_materials_emissive_strength"]})"),
              "");
    EXPECT_EQ(refusal("no glTF"), "") << "the loader says so";
}

}  // namespace
}  // namespace bounce
