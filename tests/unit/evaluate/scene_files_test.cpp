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

TEST(IsBlend, CapitalsAreNoOtherKind) {
    for (const char* name : {"a.blend", "a.BLEND", "a.b.Blend"}) EXPECT_TRUE(is_blend(name)) << name;
    for (const char* name : {"a.glb", "blend", "a.blend1", "a.blend.glb", ""})
        EXPECT_FALSE(is_blend(name)) << name;
}

TEST(NotExported, IsASentenceEach) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "a.gltf")
        << R"({"extensions": {"BOUNCE_scene": {"unsupported": [{"object": "Cup", "what": "Glass BSDF"}, 7, {}]}}})";
    EXPECT_EQ(gltf_not_exported(folder / "a.gltf"),
              std::vector<std::string>{"not exported: Cup: Glass BSDF"});
    std::ofstream(folder / "b.gltf") << "{}";
    EXPECT_TRUE(gltf_not_exported(folder / "b.gltf").empty());
    EXPECT_TRUE(gltf_not_exported(folder.path()).empty()) << "a folder is no file";
}

TEST(NamesCamera, IsWhatOurExporterWrites) {
    const test::TemporaryFolder folder;
    const std::pair<std::string, bool> cases[] = {
        {R"({"extensions": {"BOUNCE_scene": {"camera": 0}}})", true},
        {R"({"extensions": {"BOUNCE_scene": {}}})", false},
        {R"({"cameras": [{}]})", false},
        {R"({"extensions": []})", false},
        {"no glTF", false}};
    for (const auto& [text, expected] : cases) {
        std::ofstream(folder / "a.gltf") << text;
        EXPECT_EQ(gltf_names_camera(folder / "a.gltf"), expected) << text;
    }
}

}  // namespace
}  // namespace bounce
