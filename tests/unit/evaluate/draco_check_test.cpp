// SPDX-License-Identifier: Apache-2.0
#include "evaluate/draco_check.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "environment.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

namespace fs = std::filesystem;

class DracoCheckTest : public testing::Test {
  protected:
    DracoCheckTest() {
        for (const char* name : {"checkout/blender_addon/bounce", "checkout/build/release", "blender/bin"}) {
            fs::create_directories(folder_ / name);
        }
        std::ofstream(folder_ / "checkout/blender_addon/export_cli.py") << "#\n";
        std::ofstream(blender_) << "#\n";
        std::ofstream(scene_)
            << R"({"extensionsUsed": ["KHR_lights_punctual", "KHR_draco_mesh_compression"]})";
    }

    // The sentence; empty where a library was found.
    [[nodiscard]] std::string refusal() const {
        try {
            require_draco_library(scene_, blender_);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::failed);
            return error.what();
        }
        return {};
    }

    test::TemporaryFolder folder_;
    test::Environment variable_{"BLENDER_EXTERN_DRACO_LIBRARY_PATH", ""};
    test::Environment addon_{"BOUNCE_ADDON", (folder_ / "checkout/blender_addon").string()};
    fs::path blender_ = folder_ / "blender/bin/blender";
    fs::path scene_ = folder_ / "scene.gltf";
};

TEST_F(DracoCheckTest, SaysWhatToBuild) {
    EXPECT_THAT(refusal(), testing::HasSubstr("build the target extern_draco"));
    EXPECT_THAT(refusal(), testing::HasSubstr("scene.gltf"));
    fs::create_directory(folder_ / "checkout/build/libextern_draco.so");
    EXPECT_THAT(refusal(), testing::HasSubstr("extern_draco")) << "a folder is no library";
}

TEST_F(DracoCheckTest, FindsTheLibraryWhereBlenderWill) {
    for (const char* place : {"checkout/blender_addon/bounce", "checkout/build", "checkout/build/release",
                              "blender/bin/3.4/python/lib/python3.10/site-packages"}) {
        fs::create_directories(folder_ / place);
        std::ofstream(folder_ / place / "libextern_draco.so") << "a library";
        EXPECT_EQ(refusal(), "") << place;
        fs::remove(folder_ / place / "libextern_draco.so");
        EXPECT_NE(refusal(), "") << place;
    }
    // A link to Blender, as in /usr/local/bin.
    std::ofstream(folder_ / "blender/bin/3.4/python/lib/python3.10/site-packages/libextern_draco.so")
        << "a library";
    fs::create_symlink(blender_, folder_ / "link");
    blender_ = folder_ / "link";
    EXPECT_EQ(refusal(), "");
}

TEST_F(DracoCheckTest, TheUsersOwnLibraryCounts) {
    const test::Environment variable("BLENDER_EXTERN_DRACO_LIBRARY_PATH", (folder_ / "own.so").string());
    EXPECT_THAT(refusal(), testing::HasSubstr("own.so, which is no file"));
    std::ofstream(folder_ / "own.so") << "a library";
    EXPECT_EQ(refusal(), "");
}

TEST_F(DracoCheckTest, WhatIsNotCompressedNeedsNone) {
    for (const char* text :
         {R"({"extensionsUsed": ["KHR_lights_punctual"]})", "{}", R"({"extensionsUsed": 3})", "no glTF"}) {
        std::ofstream(scene_) << text;
        EXPECT_EQ(refusal(), "") << text;
    }
    scene_ = folder_ / "none.gltf";
    EXPECT_EQ(refusal(), "") << "that it is missing is said by who opens it";
}

}  // namespace
}  // namespace bounce
