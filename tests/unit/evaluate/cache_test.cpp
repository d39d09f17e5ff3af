// SPDX-License-Identifier: Apache-2.0
#include "evaluate/cache.h"

#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "core/atomic_file.h"
#include "core/error.h"
#include "environment.h"
#include "evaluate/blender_export.h"
#include "evaluate/reference.h"
#include "evaluate/sha256.h"
#include "file_size_limit.h"
#include "image/image_io.h"
#include "image/metrics.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::Environment;
using test::TemporaryFolder;
namespace fs = std::filesystem;

// Values by coreutils' sha256sum; the lengths lie around the padding's edges.
TEST(Sha256, KnownValues) {
    EXPECT_EQ(sha256_of_text(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256_of_text("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    const std::vector<std::pair<size_t, std::string>> runs_of_a{
        {55, "9f4390f8d30c2dd92ec9f095b65e2b9ae9b0a925a5258e241c9f1e910f734318"},
        {56, "b35439a4ac6f0948b6d6f9e3c6af0f5f590ce20f1bde7090ef7970686ec6738a"},
        {63, "7d3e74a05d7db15bce4ad9ec0658ea98e3f06eeecf16b4c6fff2da457ddc2f34"},
        {64, "ffe054fe7ae0cb6dc65c3af9b61d5209f439851db43d0ba5997337df154668eb"},
        {65, "635361c48bb9eab14198e76ea8ab7f1a41685d6ad62aa9146d301d4f17eb0ae0"},
        {119, "31eba51c313a5c08226adf18d4a359cfdfd8d2e816b13f4af952f7ea6584dcfb"}};
    for (const auto& [length, expected] : runs_of_a) {
        EXPECT_EQ(sha256_of_text(std::string(length, 'a')), expected) << length;
    }
}

TEST(Sha256, OfAFileAndInPieces) {
    const TemporaryFolder folder;
    const std::string text(200000, 'x');
    std::ofstream(folder / "a", std::ios::binary) << text;
    EXPECT_EQ(sha256_of_file(folder / "a"), sha256_of_text(text));
    Sha256 pieces;
    pieces.add(text.substr(0, 77777));
    pieces.add(text.substr(77777));
    EXPECT_EQ(pieces.hex_digest(), sha256_of_text(text));
    EXPECT_THROW((void)sha256_of_file(folder / "missing"), Error);
}

TEST(CacheFolder, FollowsTheEnvironment) {
    const Environment home("HOME", "/home/somebody");
    {
        const Environment cache("XDG_CACHE_HOME", "/var/cache/somebody");
        EXPECT_EQ(cache_folder(), "/var/cache/somebody/bounce");
    }
    const Environment unset("XDG_CACHE_HOME", "");
    EXPECT_EQ(cache_folder(), "/home/somebody/.cache/bounce");
}

TEST(FilesUnchanged, SeesAChangedAndAMissingFile) {
    const TemporaryFolder folder;
    std::ofstream(folder / "texture.png") << "one";
    write_file_hashes(folder / "record.json", hash_files({folder / "texture.png", folder / "absent.png"}));
    EXPECT_TRUE(files_unchanged(folder / "record.json"));
    std::ofstream(folder / "absent.png") << "now it is there";
    EXPECT_FALSE(files_unchanged(folder / "record.json"));
    fs::remove(folder / "absent.png");
    std::ofstream(folder / "texture.png") << "two";
    EXPECT_FALSE(files_unchanged(folder / "record.json"));
    std::ofstream(folder / "record.json") << "{ damaged";
    EXPECT_FALSE(files_unchanged(folder / "record.json"));
    EXPECT_FALSE(files_unchanged(folder / "no record"));
}

TEST(HashFolder, DependsOnNamesAndContents) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a.py") << "1";
    const std::string before = hash_folder(folder.path());
    fs::create_directory(folder / "__pycache__");
    std::ofstream(folder / "__pycache__/a.pyc") << "compiled";
    EXPECT_EQ(hash_folder(folder.path()), before);
    fs::rename(folder / "a.py", folder / "b.py");
    EXPECT_NE(hash_folder(folder.path()), before);
}

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

TEST(ResolveScene, LeavesGltfAsItIs) {
    const ResolvedScene scene = resolve_scene("some/scene.glb", {});
    EXPECT_EQ(scene.gltf, "some/scene.glb");
    EXPECT_FALSE(scene.exported());
}

TEST(ResolveScene, SaysWhatIsMissing) {
    const TemporaryFolder folder;
    const auto failure = [](const fs::path& path, const SceneSourceOptions& options) {
        try {
            (void)resolve_scene(path, options);
        } catch (const Error& error) {
            return std::pair{error.code(), std::string(error.what())};
        }
        return std::pair{ExitCode::done, std::string()};
    };
    EXPECT_EQ(failure(folder / "missing.blend", {}).first, ExitCode::input_refused);
    std::ofstream(folder / "a.blend") << "BLENDER";
    const auto no_blender = failure(folder / "a.blend", {folder / "no_blender"});
    EXPECT_EQ(no_blender.first, ExitCode::failed);
    EXPECT_THAT(no_blender.second, testing::HasSubstr("there is no such program"));
    const Environment variable("BLENDER", (folder / "no_blender_either").string());
    EXPECT_THAT(failure(folder / "a.blend", {}).second, testing::HasSubstr("$BLENDER"));
}

// A stand-in for Blender: writes its arguments as the "export", and lists no files.
TEST(ResolveScene, ExportsOncePerContent) {
    const TemporaryFolder folder;
    const Environment cache("XDG_CACHE_HOME", (folder / "cache").string());
    fs::create_directories(folder / "addon");
    std::ofstream(folder / "addon/export_cli.py") << "# the add-on\n";
    const Environment addon("BOUNCE_ADDON", (folder / "addon").string());
    std::ofstream(folder / "blender")
        << "#!/bin/sh\necho run >> '" << (folder / "runs").string()
        << "'\nfor last; do :; done\necho glb > \"$last\"\n"
           "for word; do case \"$word\" in *json.dump*)\n"
           "  list=${word##*open(\\\"}; echo '[]' > \"${list%%\\\"*}\";; esac; done\n";
    fs::permissions(folder / "blender", fs::perms::owner_all);
    std::ofstream(folder / "a.blend") << "one";
    const auto runs = [&] {
        std::ifstream in(folder / "runs");
        return std::count(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>(), '\n');
    };
    const SceneSourceOptions options{folder / "blender"};
    const ResolvedScene first = resolve_scene(folder / "a.blend", options);
    EXPECT_TRUE(first.exported());
    EXPECT_TRUE(fs::is_regular_file(first.gltf));
    EXPECT_EQ(resolve_scene(folder / "a.blend", options).gltf, first.gltf);
    EXPECT_EQ(runs(), 1);
    std::ofstream(folder / "a.blend") << "two";
    EXPECT_NE(resolve_scene(folder / "a.blend", options).gltf, first.gltf);
    std::ofstream(folder / "addon/export_cli.py") << "# another version\n";
    const ResolvedScene third = resolve_scene(folder / "a.blend", options);
    EXPECT_EQ(runs(), 3);
    std::ofstream(third.gltf) << "something else";
    EXPECT_EQ(resolve_scene(folder / "a.blend", options).gltf, third.gltf);
    EXPECT_EQ(runs(), 4) << "a foreign export is made again";
    EXPECT_EQ(sha256_of_file(third.gltf), sha256_of_text("glb\n"));
}

TEST(ResolveScene, PassesOnWhyTheExportFailed) {
    const TemporaryFolder folder;
    const Environment cache("XDG_CACHE_HOME", (folder / "cache").string());
    fs::create_directories(folder / "addon");
    std::ofstream(folder / "addon/export_cli.py") << "# the add-on\n";
    const Environment addon("BOUNCE_ADDON", (folder / "addon").string());
    std::ofstream(folder / "blender") << "#!/bin/sh\necho 'bounce: export failed: no camera' >&2\nexit 1\n";
    fs::permissions(folder / "blender", fs::perms::owner_all);
    std::ofstream(folder / "a.blend") << "one";
    try {
        (void)resolve_scene(folder / "a.blend", {folder / "blender"});
        FAIL() << "resolved";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        EXPECT_THAT(error.what(), testing::EndsWith("a.blend: no camera"));
    }
    EXPECT_TRUE(fs::is_empty(folder / "cache/bounce/exports")) << "a failed export left a file";

    const test::FileSizeLimit full(60000);  // less than an export is given
    try {
        (void)resolve_scene(folder / "a.blend", {folder / "blender"});
        FAIL() << "resolved";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::failed);
        EXPECT_THAT(error.what(), testing::HasSubstr("there is no room for the export of"));
    }
}

}  // namespace
}  // namespace bounce
