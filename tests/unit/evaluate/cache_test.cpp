// SPDX-License-Identifier: Apache-2.0
#include "evaluate/cache.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "environment.h"
#include "evaluate/blender_export.h"
#include "evaluate/sha256.h"
#include "file_size_limit.h"
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
