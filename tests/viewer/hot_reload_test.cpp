// SPDX-License-Identifier: Apache-2.0
#include "viewer/hot_reload.h"

#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "temporary_folder.h"

namespace bounce::viewer {
namespace {

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

TEST(FileWatch, TellsOfAChangeOnceItHasComeToRest) {
    const test::TemporaryFolder folder;
    write(folder / "a", "one");
    FileWatch watch(folder / "a");
    EXPECT_FALSE(watch.changed(0.0));
    EXPECT_FALSE(watch.changed(10.0));
    write(folder / "a", "three");
    EXPECT_FALSE(watch.changed(20.0));  // seen, not at rest
    EXPECT_FALSE(watch.changed(20.1));
    EXPECT_TRUE(watch.changed(20.5));
    EXPECT_FALSE(watch.changed(30.0));
}

TEST(FileWatch, WaitsWhileTheFileGrows) {
    const test::TemporaryFolder folder;
    write(folder / "a", "one");
    FileWatch watch(folder / "a");
    std::string text = "one";
    for (int i = 1; i < 5; ++i) {
        text += "more";
        write(folder / "a", text);
        EXPECT_FALSE(watch.changed(i));  // long after the change before, but it is another one
    }
    EXPECT_TRUE(watch.changed(5.0));
}

TEST(FileWatch, SeesAChangeOfTimeAlone) {
    const test::TemporaryFolder folder;
    write(folder / "a", "one");
    FileWatch watch(folder / "a");
    std::filesystem::last_write_time(
        folder / "a", std::filesystem::last_write_time(folder / "a") + std::chrono::seconds(1));
    EXPECT_FALSE(watch.changed(0.0));
    EXPECT_TRUE(watch.changed(1.0));
}

TEST(FileWatch, AFileThatVanishesIsNoChangeUntilItIsBack) {
    const test::TemporaryFolder folder;
    write(folder / "a", "one");
    FileWatch watch(folder / "a");
    std::filesystem::remove(folder / "a");
    EXPECT_FALSE(watch.changed(0.0));
    EXPECT_FALSE(watch.changed(10.0));
    write(folder / "a", "another");
    EXPECT_FALSE(watch.changed(11.0));
    EXPECT_TRUE(watch.changed(12.0));
}

TEST(SceneReloader, SaysWhyABrokenFileIsNotLoaded) {
    const test::TemporaryFolder folder;
    write(folder / "a.glb", "x");
    const auto path = folder / "a.glb";
    SceneReloader reloader(path, [path] { return scene::load_gltf(path); });
    write(folder / "a.glb", "no scene");
    std::optional<SceneReloader::Loaded> loaded;
    // Its thread needs a moment; the clock given is far ahead, so only that is waited for.
    for (int i = 0; i < 1000 && !loaded; ++i) {
        loaded = reloader.poll(i);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_TRUE(loaded);
    const auto* why_not = std::get_if<std::string>(&*loaded);
    ASSERT_NE(why_not, nullptr);
    EXPECT_NE(why_not->find("a.glb"), std::string::npos);
    EXPECT_FALSE(reloader.poll(5000.0));
}

}  // namespace
}  // namespace bounce::viewer
