// SPDX-License-Identifier: Apache-2.0
#include "evaluate/scene_files.h"

#include <fstream>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "temporary_folder.h"

namespace bounce {
namespace {

TEST(IsGltf, TellsAnObjectFromAnythingElse) {
    const test::TemporaryFolder folder;
    const std::pair<std::string, bool> cases[] = {
        {R"({"asset": {}})", true}, {"{}", true}, {"no glTF", false}, {"[]", false}, {"", false}};
    for (const auto& [text, expected] : cases) {
        std::ofstream(folder / "a.gltf") << text;
        EXPECT_EQ(is_gltf(folder / "a.gltf"), expected) << text;
    }
    EXPECT_FALSE(is_gltf(folder / "missing.gltf"));
}

}  // namespace
}  // namespace bounce
