// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/process.h"

namespace bounce {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class InfoCommand : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("bounce-info-" + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    [[nodiscard]] fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }

    static ProcessResult info(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {BOUNCE_BINARY_DIR "/bounce", "info"});
        return run_process(arguments);
    }

    fs::path folder_;
};

// A lamp, a camera and a triangle.
constexpr const char* k_scene = R"({
  "asset": {"version": "2.0"},
  "extensionsUsed": ["BOUNCE_scene", "KHR_materials_sheen"],
  "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
  "nodes": [
    {"name": "Triangle", "mesh": 0},
    {"name": "Lamp", "extensions": {"BOUNCE_scene": {"light": 0}}},
    {"name": "Eye", "camera": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
  "extensions": {"BOUNCE_scene": {"version": 1, "generator": {"blender": [3, 4, 1]},
    "frames": {"start": 1, "end": 48, "fps": 24}, "world": {"color": [1, 1, 1], "strength": 0.25}, "camera": 2,
    "lights": [{"name": "Light", "type": "area", "power_w": 40, "shape": "square", "size_x_m": 1, "size_y_m": 1}],
    "unsupported": [{"object": "Fog", "what": "volumes"}]}}
})";

TEST_F(InfoCommand, SaysWhatIsThere) {
    const ProcessResult result = info({write("scene.gltf", k_scene).string()});
    EXPECT_EQ(result.exit_code, 0) << result.output;
    for (const char* part :
         {"from Blender 3.4.1", "1 triangles", "1 x 1 x 0 m", "1 to 48 at 24", "Lamp",
          "40 W, square of 1 x 1 m\n", "Eye", "active", "Fog: volumes", "KHR_materials_sheen"}) {
        EXPECT_THAT(result.output, HasSubstr(part));
    }
}

TEST_F(InfoCommand, SaysItInJson) {
    const ProcessResult result = info({write("scene.gltf", k_scene).string(), "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.output;
    const auto json = nlohmann::json::parse(result.output);
    EXPECT_EQ(json["schema"], "bounce.info/1");
    EXPECT_EQ(json["counts"]["triangles"], 1);
    EXPECT_EQ(json["frames"]["end"], 48);
    EXPECT_EQ(json["lights"][0]["power_w"], 40.0);
    EXPECT_EQ(json["lights"][0]["shape"], "square");
    EXPECT_EQ(json["world"]["image"], nullptr);
    EXPECT_EQ(json["cameras"][0]["active"], true);
    EXPECT_EQ(json["unsupported"][0]["object"], "Fog");
    EXPECT_EQ(json["warnings"].size(), 1U);
    EXPECT_EQ(json["bounds"]["high"][0], 1.0);
    EXPECT_EQ(json["features"]["emissive"], false);
}

TEST_F(InfoCommand, RefusesWithOneSentence) {
    ProcessResult result = info({(folder_ / "missing.glb").string()});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.output, HasSubstr("missing.glb"));
    result = info({write("bad.gltf", "{").string()});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
    EXPECT_EQ(info({}).exit_code, 2);
}

}  // namespace
}  // namespace bounce
