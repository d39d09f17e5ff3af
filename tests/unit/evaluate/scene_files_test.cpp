// SPDX-License-Identifier: Apache-2.0
#include "evaluate/scene_files.h"

#include <fstream>

#include <gtest/gtest.h>

#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;

bool leaves_to_defaults(const std::string& json) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a.gltf") << json;
    return gltf_leaves_to_defaults(folder / "a.gltf");
}

TEST(GltfLeavesToDefaults, WhereCameraOrWorldIsNotSaid) {
    EXPECT_TRUE(leaves_to_defaults(R"({})"));
    EXPECT_TRUE(leaves_to_defaults(R"({"nodes": [{"camera": 0}]})")) << "the world is not said";
    EXPECT_TRUE(leaves_to_defaults(R"({"nodes": [{}], "extensionsUsed": ["BOUNCE_scene"]})"));
    EXPECT_FALSE(leaves_to_defaults(R"({"nodes": [{"camera": 0}], "extensionsUsed": ["BOUNCE_scene"]})"));
}

TEST(GltfLeavesToDefaults, NotOfWhatTheLoaderRefuses) {
    for (const char* text : {"no glTF", "[]", R"({"nodes": {"camera": 0}, "extensionsUsed": 3})"}) {
        EXPECT_NO_THROW((void)leaves_to_defaults(text)) << text;
    }
    EXPECT_FALSE(leaves_to_defaults("no glTF"));
}

}  // namespace
}  // namespace bounce
