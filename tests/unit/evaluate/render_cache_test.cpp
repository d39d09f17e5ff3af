// SPDX-License-Identifier: Apache-2.0
#include "evaluate/render_cache.h"

#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "core/atomic_file.h"
#include "core/error.h"
#include "evaluate/sha256.h"
#include "image/image_io.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;
namespace fs = std::filesystem;

CachedRender example(float value = 0.3F) {
    CachedRender render;
    render.image = Image(8, 4);
    std::fill(render.image.rgb.begin(), render.image.rgb.end(), value);
    render.seconds = 2.5;
    render.rss_peak_bytes = 1000;
    render.date = "2024-01-02T03:04:05Z";
    render.notes = {"a note"};
    return render;
}

class RenderCacheTest : public testing::Test {
  protected:
    [[nodiscard]] fs::path file(const std::string& key, const char* extension) const {
        return folder_ / (sha256_of_text(key).substr(0, 32) + extension);
    }

    TemporaryFolder folder_;
    RenderCache cache_{folder_.path(), 8, 4};
};

TEST_F(RenderCacheTest, GivesBackWhatWasStored) {
    EXPECT_FALSE(cache_.load("key"));
    cache_.store("key", example(), {});
    const auto found = cache_.load("key");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->image.rgb, example().image.rgb) << "all 32 bits of a value";
    EXPECT_EQ(found->seconds, 2.5);
    EXPECT_EQ(found->rss_peak_bytes, 1000U);
    EXPECT_EQ(found->notes, example().notes);
    EXPECT_FALSE(cache_.load("another key"));
    cache_.remove("key");
    EXPECT_FALSE(cache_.load("key"));
}

TEST_F(RenderCacheTest, AHalfWrittenEntryIsMadeAgain) {
    cache_.store("key", example(), {});
    fs::remove(file("key", ".json"));
    EXPECT_FALSE(cache_.load("key")) << "killed before the record";
    cache_.store("key", example(), {});
    fs::resize_file(file("key", ".exr"), fs::file_size(file("key", ".exr")) / 2);
    EXPECT_FALSE(cache_.load("key")) << "half a picture";
    cache_.store("key", example(), {});
    fs::resize_file(file("key", ".json"), 20);
    EXPECT_FALSE(cache_.load("key")) << "half a record";
    cache_.store("key", example(), {});
    EXPECT_TRUE(cache_.load("key"));
}

TEST_F(RenderCacheTest, AForeignEntryIsMadeAgain) {
    cache_.store("mine", example(0.3F), {});
    cache_.store("foreign", example(0.7F), {});
    // A whole and valid picture of something else, under this one's name.
    for (const char* extension : {".exr", ".json", ".files.json"}) {
        fs::copy_file(file("foreign", extension), file("mine", extension),
                      fs::copy_options::overwrite_existing);
    }
    EXPECT_FALSE(cache_.load("mine"));
    cache_.store("mine", example(0.3F), {});
    fs::copy_file(file("foreign", ".exr"), file("mine", ".exr"), fs::copy_options::overwrite_existing);
    EXPECT_FALSE(cache_.load("mine")) << "another picture beside a right record";
}

TEST_F(RenderCacheTest, AnImpossibleRecordIsMadeAgain) {
    cache_.store("key", example(), {});
    std::ifstream in(file("key", ".json"));
    const nlohmann::json right = nlohmann::json::parse(in);
    const std::vector<std::pair<const char*, nlohmann::json>> wrong{
        {"seconds", -1},       {"seconds", nullptr}, {"setup_seconds", "1"}, {"rss_peak_bytes", -1},
        {"notes", {{"a", 1}}}, {"date", 3},          {"image_sha256", {1}}};
    for (const auto& [name, value] : wrong) {
        nlohmann::json changed = right;
        changed[name] = value;
        write_text_file(file("key", ".json"), changed.dump());
        EXPECT_FALSE(cache_.load("key")) << name << ' ' << value;
    }
}

TEST_F(RenderCacheTest, WhatIsNoFileIsMadeAgain) {
    for (const char* extension : {".json", ".files.json", ".exr"}) {
        for (const bool pipe : {false, true}) {
            cache_.store("key", example(), {});
            fs::remove(file("key", extension));
            if (pipe) {
                ASSERT_EQ(mkfifo(file("key", extension).c_str(), 0600), 0);
            } else {
                fs::create_directory(file("key", extension));
            }
            EXPECT_FALSE(cache_.load("key")) << extension;
        }
    }
    cache_.store("key", example(), {});
    EXPECT_TRUE(cache_.load("key"));
}

TEST_F(RenderCacheTest, AnotherSizeIsMadeAgain) {
    cache_.store("key", example(), {});
    EXPECT_FALSE(RenderCache(folder_.path(), 16, 8).load("key"));
}

TEST_F(RenderCacheTest, AChangedTextureIsSeen) {
    std::ofstream(folder_ / "texture.png") << "one";
    cache_.store("key", example(), {folder_ / "texture.png"});
    EXPECT_TRUE(cache_.load("key"));
    std::ofstream(folder_ / "texture.png") << "two";
    EXPECT_FALSE(cache_.load("key"));
}

TEST_F(RenderCacheTest, ADiskThatTakesNothingIsNotTheEnd) {
    std::ofstream(folder_ / "file") << "not a folder";
    const RenderCache nowhere(folder_ / "file", 8, 4);
    EXPECT_THROW(nowhere.store("key", example(), {}), Error);
    EXPECT_NO_THROW(nowhere.store_or_warn("key", example(), {}));
}

}  // namespace
}  // namespace bounce
