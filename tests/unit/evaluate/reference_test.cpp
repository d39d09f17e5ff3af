// SPDX-License-Identifier: Apache-2.0
#include "evaluate/reference.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "core/atomic_file.h"
#include "core/error.h"
#include "evaluate/cache.h"
#include "evaluate/sha256.h"
#include "image/image_io.h"
#include "image/metrics.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;
namespace fs = std::filesystem;

const ReferenceKey k_key{"scene", 1, 4, 2, 1024, 1, "Blender 3.4.1", "scripts"};

TEST(CacheName, EveryInputCounts) {
    std::set<std::string> names{cache_name(k_key)};
    const auto add = [&](auto change) {
        ReferenceKey key = k_key;
        change(key);
        names.insert(cache_name(key));
    };
    add([](ReferenceKey& key) { key.scene_hash = "other"; });
    add([](ReferenceKey& key) { key.frame = 24; });
    add([](ReferenceKey& key) { key.width = 641; });
    add([](ReferenceKey& key) { key.height = 361; });
    add([](ReferenceKey& key) { key.spp = 512; });
    add([](ReferenceKey& key) { key.bounces = 2; });
    add([](ReferenceKey& key) { key.blender = "Blender 4.2.0"; });
    add([](ReferenceKey& key) { key.scripts_hash = "other"; });
    EXPECT_EQ(names.size(), 9U);
    EXPECT_EQ(cache_name(k_key), cache_name(k_key));
}

Image constant(float value) {
    Image image(4, 2);
    std::fill(image.rgb.begin(), image.rgb.end(), value);
    return image;
}

TEST(Reference, NoiseFloorByHand) {
    // Halves 1.1 and 0.9: their mean 1 is off by an expected (0.2 / 2)^2 = 0.01, over 1 + 0.01.
    const Reference reference = make_reference(constant(1.1F), constant(0.9F), 64);
    EXPECT_NEAR(reference.image.rgb[0], 1.0F, 1e-6);
    EXPECT_NEAR(reference.noise_floor, 0.01 / 1.01, 1e-6);
}

// Weights 1/4 and 3/4; variances of independent means add with the squares of their weights.
TEST(Reference, MergesByHand) {
    Reference a = make_reference(constant(1.1F), constant(0.9F), 100);
    Reference b = make_reference(constant(1.25F), constant(1.15F), 300);
    a.seconds = 2.0;
    b.seconds = 5.0;
    const Reference merged = merge(a, b);
    EXPECT_NEAR(merged.image.rgb[0], 0.25 * 1.0 + 0.75 * 1.2, 1e-6);
    EXPECT_NEAR(merged.noise_floor, 0.0625 * a.noise_floor + 0.5625 * b.noise_floor, 1e-9);
    EXPECT_EQ(merged.spp, 400);
    EXPECT_EQ(merged.batches, 2);
    EXPECT_EQ(merged.seconds, 7.0);
}

// The floor's estimate against what it estimates: many batches of known noise around a known picture.
TEST(Reference, FloorOfManyBatchesIsTheErrorOfTheirMean) {
    std::mt19937 random(7);
    std::normal_distribution<float> noise(0.0F, 0.1F);
    const auto noisy = [&] {
        Image image(64, 64);
        for (float& value : image.rgb) value = 1.0F + noise(random);
        return image;
    };
    Reference sum = make_reference(noisy(), noisy(), 128);
    for (int i = 0; i < 7; ++i) {
        sum = merge(sum, make_reference(noisy(), noisy(), 128));
    }
    Image exact(64, 64);
    std::fill(exact.rgb.begin(), exact.rgb.end(), 1.0F);
    const double error = relmse(exact, sum.image);
    EXPECT_NEAR(error, 0.01 / 16 / 1.01, 5e-5);
    EXPECT_NEAR(sum.noise_floor, error, 0.05 * error) << "12,288 values: 1.3 % is one standard deviation";
}

TEST(Reference, OneWithMoreSamplesTakesThePlace) {
    const TemporaryFolder folder;
    const Reference first = make_reference(constant(0.75F), constant(0.25F), 64);
    store_reference(folder.path(), k_key, first, {});
    store_reference(folder.path(), k_key, merge(first, first), {});
    const auto found = load_reference(folder.path(), k_key);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->spp, 128);
    EXPECT_EQ(found->batches, 2);
    EXPECT_FALSE(fs::exists(folder / (cache_name(k_key) + "-64.exr")));
}

TEST(Reference, IsFoundAgainUntilSomethingChanges) {
    const TemporaryFolder folder;
    std::ofstream(folder / "texture.png") << "one";
    Reference reference = make_reference(constant(0.75F), constant(0.25F), 64);
    reference.seconds = 12.5;
    EXPECT_FALSE(load_reference(folder.path(), k_key));
    store_reference(folder.path(), k_key, reference, {folder / "texture.png"});

    const auto found = load_reference(folder.path(), k_key);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->image.rgb, reference.image.rgb);
    EXPECT_EQ(found->noise_floor, reference.noise_floor);
    EXPECT_EQ(found->seconds, 12.5);
    EXPECT_TRUE(found->cached);

    ReferenceKey other = k_key;
    other.frame = 2;
    EXPECT_FALSE(load_reference(folder.path(), other));
    std::ofstream(folder / "texture.png") << "two";
    EXPECT_FALSE(load_reference(folder.path(), k_key)) << "a texture of the scene has changed";
}

TEST(Reference, ADamagedFileIsRenderedAgain) {
    const TemporaryFolder folder;
    store_reference(folder.path(), k_key, make_reference(constant(0.5F), constant(0.5F), 64), {});
    std::ofstream(folder / (cache_name(k_key) + "-64.exr")) << "cut";
    EXPECT_FALSE(load_reference(folder.path(), k_key));
    store_reference(folder.path(), k_key, make_reference(constant(0.5F), constant(0.5F), 64), {});
    EXPECT_TRUE(load_reference(folder.path(), k_key));
    std::ofstream(folder / (cache_name(k_key) + ".json")) << "{\"image\": ";
    EXPECT_FALSE(load_reference(folder.path(), k_key));
}

// Each is whole JSON, and beside a right picture.
TEST(Reference, AnImpossibleRecordIsRenderedAgain) {
    const TemporaryFolder folder;
    const fs::path record = folder / (cache_name(k_key) + ".json");
    const auto store = [&] {
        store_reference(folder.path(), k_key, make_reference(constant(0.5F), constant(0.5F), 64), {});
    };
    store();
    ASSERT_TRUE(load_reference(folder.path(), k_key));
    std::ifstream in(record);
    const nlohmann::json right = nlohmann::json::parse(in);
    const std::vector<std::pair<const char*, nlohmann::json>> wrong{{"noise_floor_relmse", nullptr},
                                                                    {"noise_floor_relmse", -1.0},
                                                                    {"noise_floor_relmse", "0"},
                                                                    {"seconds", -1},
                                                                    {"seconds", {1, 2}},
                                                                    {"spp", -5},
                                                                    {"spp", 0},
                                                                    {"spp", 3.7},
                                                                    {"spp", 1e30},
                                                                    {"batches", -1},
                                                                    {"batches", 33},
                                                                    {"key", 3},
                                                                    {"image_sha256", {1}},
                                                                    {"image", ""},
                                                                    {"image", "/"},
                                                                    {"image", 7}};
    for (const auto& [name, value] : wrong) {
        nlohmann::json changed = right;
        changed[name] = value;
        write_text_file(record, changed.dump());
        EXPECT_FALSE(load_reference(folder.path(), k_key)) << name << ' ' << value;
    }
    for (const char* text : {"", "[1]", "7", "{\"key\":", "\xff\xfe"}) {
        write_text_file(record, text);
        EXPECT_FALSE(load_reference(folder.path(), k_key)) << text;
    }
    store();
    EXPECT_TRUE(load_reference(folder.path(), k_key));
}

// What the record names is looked for beside it alone.
TEST(Reference, APictureElsewhereIsNotTaken) {
    const TemporaryFolder folder;
    const fs::path cache = folder / "cache";
    store_reference(cache, k_key, make_reference(constant(0.5F), constant(0.5F), 64), {});
    const std::string image = cache_name(k_key) + "-64.exr";
    fs::rename(cache / image, folder / image);
    std::ifstream in(cache / (cache_name(k_key) + ".json"));
    nlohmann::json record = nlohmann::json::parse(in);
    for (const std::string& name : {"../" + image, (folder / image).string()}) {
        record["image"] = name;
        write_text_file(cache / (cache_name(k_key) + ".json"), record.dump());
        EXPECT_FALSE(load_reference(cache, k_key)) << name;
    }
}

// The hash is right, so that nothing but the picture itself tells.
TEST(Reference, ADamagedPictureOfARightHashIsRenderedAgain) {
    const TemporaryFolder folder;
    const fs::path image = folder / (cache_name(k_key) + "-64.exr");
    const fs::path record_file = folder / (cache_name(k_key) + ".json");
    const auto with = [&](const std::function<void()>& spoil) {
        store_reference(folder.path(), k_key, make_reference(constant(0.5F), constant(0.5F), 64), {});
        spoil();
        std::ifstream in(record_file);
        nlohmann::json record = nlohmann::json::parse(in);
        record["image_sha256"] = sha256_of_file(image);
        write_text_file(record_file, record.dump());
        return load_reference(folder.path(), k_key).has_value();
    };
    EXPECT_TRUE(with([] {})) << "this is what the test is about";
    EXPECT_FALSE(with([&] { fs::resize_file(image, fs::file_size(image) - 30); }));
    EXPECT_FALSE(with([&] { fs::resize_file(image, 0); }));
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        EXPECT_FALSE(with([&] { write_image(image, constant(value), {}, ExrValues::full); })) << value;
    }
}

// Folders, pipes, devices and links without end in the place of each file. A pipe would be waited for.
TEST(Reference, WhatIsNoFileIsRenderedAgain) {
    const TemporaryFolder folder;
    const std::vector<std::pair<const char*, std::function<void(const fs::path&)>>> kinds{
        {"a folder", [](const fs::path& path) { fs::create_directory(path); }},
        {"a pipe", [](const fs::path& path) { ASSERT_EQ(mkfifo(path.c_str(), 0600), 0); }},
        {"a device", [](const fs::path& path) { fs::create_symlink("/dev/zero", path); }},
        {"a link to itself", [](const fs::path& path) { fs::create_symlink(path, path); }}};
    for (const char* extension : {".json", ".files.json", "-64.exr"}) {
        const fs::path path = folder / (cache_name(k_key) + extension);
        for (const auto& [kind, make] : kinds) {
            store_reference(folder.path(), k_key, make_reference(constant(0.5F), constant(0.5F), 64), {});
            fs::remove(path);
            make(path);
            EXPECT_FALSE(load_reference(folder.path(), k_key)) << extension << ' ' << kind;
            fs::remove(path);  // nothing is written in the place of a folder
        }
    }
    store_reference(folder.path(), k_key, make_reference(constant(0.5F), constant(0.5F), 64), {});
    EXPECT_TRUE(load_reference(folder.path(), k_key));
}

// Files of another reference under this one's name, and one of another size.
TEST(Reference, AForeignFileIsRenderedAgain) {
    const TemporaryFolder folder;
    ReferenceKey key = k_key;
    key.width = 4;
    key.height = 2;
    ReferenceKey other = key;
    other.frame = 2;
    const Reference reference = make_reference(constant(0.5F), constant(0.5F), 64);
    store_reference(folder.path(), key, reference, {});
    store_reference(folder.path(), other, make_reference(constant(0.7F), constant(0.7F), 64), {});
    ASSERT_TRUE(load_reference(folder.path(), key));
    const auto take = [&](const char* extension) {
        fs::copy_file(folder / (cache_name(other) + extension), folder / (cache_name(key) + extension),
                      fs::copy_options::overwrite_existing);
    };
    take("-64.exr");
    EXPECT_FALSE(load_reference(folder.path(), key)) << "another picture beside its record";
    take(".json");
    EXPECT_FALSE(load_reference(folder.path(), key)) << "another whole reference";
    ReferenceKey larger = key;
    larger.width = 8;
    store_reference(folder.path(), larger, reference, {});
    EXPECT_FALSE(load_reference(folder.path(), larger)) << "4 x 2 pixels under the name of 8 x 2";
}

}  // namespace
}  // namespace bounce
