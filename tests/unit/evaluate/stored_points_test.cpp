// SPDX-License-Identifier: Apache-2.0
#include "evaluate/stored_points.h"

#include <fstream>
#include <set>

#include <gtest/gtest.h>

#include "core/error.h"
#include "environment.h"
#include "evaluate/scene_files.h"
#include "evaluate/stored_runs.h"
#include "fake_programs.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;
namespace fs = std::filesystem;

const PointKey k_key{"scene", "program", "machine", {1, 24}, 8, 4, 3, 0, {"--vpls", "64"}};

class StoredPointTest : public testing::Test {
  protected:
    // A point as a run leaves it.
    void store() {
        test::write_constant(folder_ / "picture.exr", 0.6F, 8, 4);
        const PreviewResult result = run_preview(test::fake_bounce(folder_.path()), "scene.glb",
                                                 {"VPLs", "64", k_key.render_arguments}, k_key.frames, 8, 4,
                                                 3, points_ / point_name(k_key));
        keep_point(points_, k_key, result);
    }
    [[nodiscard]] fs::path file(const std::string& name) const { return points_ / point_name(k_key) / name; }

    TemporaryFolder folder_;
    fs::path points_ = folder_ / "points";
};

TEST_F(StoredPointTest, IsFoundAgain) {
    EXPECT_FALSE(load_point(points_, k_key));
    store();
    const auto found = load_point(points_, k_key);
    ASSERT_TRUE(found);
    ASSERT_EQ(found->frames.size(), 2U);
    EXPECT_DOUBLE_EQ(found->frames[1].seconds, 0.020);
    EXPECT_EQ(found->frames[1].all_seconds, (std::vector<double>{0.030, 0.020, 0.020}));
    EXPECT_EQ(found->frames[1].image, file("frame.0024.exr"));
    EXPECT_EQ(found->gl_renderer, "r");
    EXPECT_GT(found->startup_seconds, -1e-9);
    EXPECT_GT(found->start_seconds, 0.040);
    EXPECT_DOUBLE_EQ(found->load_seconds, 0.250);
}

TEST_F(StoredPointTest, AHalfWrittenOrDamagedOneIsNone) {
    store();
    fs::copy(points_, folder_ / "whole", fs::copy_options::recursive);
    const auto after = [&](auto damage) {
        fs::remove_all(points_);
        fs::copy(folder_ / "whole", points_, fs::copy_options::recursive);
        EXPECT_TRUE(load_point(points_, k_key));
        damage();
        return load_point(points_, k_key).has_value();
    };
    EXPECT_FALSE(after([&] { fs::remove(file("point.json")); })) << "killed before the record";
    EXPECT_FALSE(after([&] { fs::remove(file("frame.0024.exr")); }));
    EXPECT_FALSE(after([&] { fs::resize_file(file("frame.0001.exr"), 100); }));
    EXPECT_FALSE(after([&] { fs::resize_file(file("point.json"), 40); }));
    EXPECT_FALSE(after([&] { std::ofstream(file("point.json")) << "{\"schema\": \"bounce.point/1\"}"; }));
    EXPECT_FALSE(after([&] { std::ofstream(file("point.json")) << "{\"schema\": 7}"; }));
    EXPECT_FALSE(after([&] { std::ofstream(file("stats.json")) << "{\"frames\": []}"; }));
    EXPECT_FALSE(after([&] {
        std::ofstream(file("point.json"))
            << "{\"schema\": \"bounce.point/1\", \"startup_seconds\": 1, \"sha256\": {}}";
    })) << "a record that vouches for nothing";
}

TEST(PointName, EveryInputCounts) {
    std::set<std::string> names{point_name(k_key)};
    const auto add = [&](auto change) {
        PointKey key = k_key;
        change(key);
        names.insert(point_name(key));
    };
    add([](PointKey& key) { key.scene_hash = "other"; });
    add([](PointKey& key) { key.program_hash = "other"; });
    add([](PointKey& key) { key.machine = "other"; });
    add([](PointKey& key) { key.frames = {1}; });
    add([](PointKey& key) { key.width = 9; });
    add([](PointKey& key) { key.height = 5; });
    add([](PointKey& key) { key.repeat = 5; });
    add([](PointKey& key) { key.round = 1; });
    add([](PointKey& key) { key.render_arguments = {"--vpls", "128"}; });
    add([](PointKey& key) { key.render_arguments = {"--vpls 64"}; });
    EXPECT_EQ(names.size(), 11U);
}

TEST(ProgramFingerprint, ChangesWithTheProgramAndItsShaders) {
    const TemporaryFolder folder;
    std::ofstream(folder / "bounce") << "one";
    fs::create_directories(folder / "shaders");
    std::ofstream(folder / "shaders/a.comp") << "one";
    const std::string packed = program_fingerprint(folder / "bounce");
    {
        const test::Environment shaders("BOUNCE_SHADER_DIR", (folder / "shaders").string());
        const std::string from_folder = program_fingerprint(folder / "bounce");
        EXPECT_NE(from_folder, packed);
        std::ofstream(folder / "shaders/a.comp") << "two";
        EXPECT_NE(program_fingerprint(folder / "bounce"), from_folder);
    }
    std::ofstream(folder / "bounce") << "two";
    EXPECT_NE(program_fingerprint(folder / "bounce"), packed);
    EXPECT_THROW((void)program_fingerprint(folder / "missing"), Error);
}

TEST(MachineFingerprint, HoldsWhatChoosesTheDriver) {
    const std::string usual = machine_fingerprint();
    const test::Environment driver("GALLIUM_DRIVER", "another");
    EXPECT_NE(machine_fingerprint(), usual);
}

TEST(GltfExternalFiles, OfBothKindsOfFile) {
    const TemporaryFolder folder;
    const std::string json =
        R"({"buffers":[{"uri":"a%20b.bin"},{"byteLength":3}],)"
        R"("images":[{"uri":"data:image/png;base64,"},{"uri":"t.png"},{"bufferView":0}]})";
    std::ofstream(folder / "scene.gltf") << json;
    std::string header = "glTF";
    for (const size_t number : {size_t{2}, 20 + json.size(), json.size(), size_t{0x4E4F534A}}) {
        for (size_t i = 0; i < 4; ++i) {
            header += static_cast<char>(number >> (8 * i) & 0xFFU);
        }
    }
    std::ofstream(folder / "scene.glb", std::ios::binary) << header << json << "BINARY";
    const std::vector<fs::path> files{folder / "a b.bin", folder / "t.png"};
    EXPECT_EQ(gltf_external_files(folder / "scene.gltf"), files);
    EXPECT_EQ(gltf_external_files(folder / "scene.glb"), files);
    std::ofstream(folder / "short.glb") << "glTF";
    EXPECT_TRUE(gltf_external_files(folder / "short.glb").empty());

    const std::string before = sha256_of_gltf(folder / "scene.glb");
    std::ofstream(folder / "t.png") << "pixels";
    EXPECT_NE(sha256_of_gltf(folder / "scene.glb"), before);
}

TEST(MergeRounds, MedianAndSpreadAreOfAllRounds) {
    const TemporaryFolder folder;
    test::write_constant(folder / "a.exr", 0.5F, 8, 4);
    test::write_constant(folder / "b.exr", 0.6F, 8, 4);
    write_image(folder / "a2.exr", read_image(folder / "a.exr"), {{"bounce:frame", "another header"}});
    const auto round = [&](const char* image, std::vector<double> seconds) {
        PreviewResult result;
        result.frames = {{7, seconds.front(), folder / image, seconds}};
        result.startup_seconds = seconds.front();
        return result;
    };
    testing::internal::CaptureStderr();
    const PreviewResult merged =
        merge_rounds({round("a.exr", {1, 2, 9}), round("a2.exr", {4, 5, 6})}, "VPLs, 64");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    ASSERT_EQ(merged.frames.size(), 1U);
    EXPECT_EQ(merged.frames[0].all_seconds, (std::vector<double>{1, 2, 9, 4, 5, 6}));
    EXPECT_EQ(merged.frames[0].seconds, 4.5);
    EXPECT_EQ(merged.startup_seconds, 1);
    testing::internal::CaptureStderr();
    (void)merge_rounds({round("a.exr", {1}), round("b.exr", {1})}, "VPLs, 64");
    EXPECT_NE(testing::internal::GetCapturedStderr().find("VPLs, 64: frame 7"), std::string::npos);
}

}  // namespace
}  // namespace bounce
