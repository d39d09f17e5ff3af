// SPDX-License-Identifier: Apache-2.0
//
// Real files: everything that is valid must load and make sense at any time; nothing that is malformed
// may crash. They lie outside the repository, in $BOUNCE_SCENES_DIR.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "gltf_builder.h"
#include "scene/pose.h"

namespace bounce::scene::test {
namespace fs = std::filesystem;
namespace {

fs::path scenes_folder() {
    const char* variable = std::getenv("BOUNCE_SCENES_DIR");
    return variable != nullptr ? fs::path(variable)
                               : fs::path(BOUNCE_SOURCE_DIR) / ".." / "shared" / "scenes";
}

std::vector<fs::path> gltf_files(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf") {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

bool finite(const glm::dmat4& matrix) {
    for (glm::length_t column = 0; column < 4; ++column) {
        for (glm::length_t row = 0; row < 4; ++row) {
            if (!std::isfinite(matrix[column][row])) {
                return false;
            }
        }
    }
    return true;
}

void expect_sane_primitive(const Primitive& primitive, const Scene& scene) {
    const size_t count = primitive.positions.size();
    EXPECT_GT(count, 0U);
    EXPECT_EQ(primitive.normals.size(), count);
    EXPECT_EQ(primitive.indices.size() % 3, 0U);
    const auto is_stream = [&](size_t size) { return size == 0 || size == count; };
    EXPECT_TRUE(is_stream(primitive.tangents.size()) && is_stream(primitive.uv0.size()) &&
                is_stream(primitive.uv1.size()) && is_stream(primitive.colors.size()) &&
                is_stream(primitive.joints.size()));
    EXPECT_EQ(primitive.weights.size(), primitive.joints.size());
    EXPECT_TRUE(std::all_of(primitive.indices.begin(), primitive.indices.end(),
                            [&](uint32_t index) { return index < count; }));
    EXPECT_TRUE(std::all_of(primitive.positions.begin(), primitive.positions.end(), [](const glm::vec3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    }));
    EXPECT_TRUE(std::all_of(primitive.normals.begin(), primitive.normals.end(),
                            [](const glm::vec3& n) { return std::abs(glm::length(n) - 1.0F) < 1e-3F; }));
    EXPECT_LT(primitive.material, static_cast<int>(scene.materials.size()));
}

void expect_sane_pose(const Scene& scene, double time_s, int animation) {
    const Pose pose = evaluate_pose(scene, time_s, animation);
    EXPECT_TRUE(std::all_of(pose.world_from_node.begin(), pose.world_from_node.end(), finite));
    for (const auto& skin : pose.skins) {
        EXPECT_TRUE(std::all_of(skin.begin(), skin.end(), finite));
    }
    const Bounds bounds = world_bounds(scene, pose);
    EXPECT_EQ(bounds.empty(), pose.draws.empty());
    EXPECT_TRUE(std::isfinite(bounds.diagonal()));
}

void expect_sane(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            expect_sane_primitive(primitive, scene);
        }
    }
    for (const Image& image : scene.images) {
        const size_t numbers = static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * 4;
        EXPECT_TRUE(image.rgba8.size() == numbers || image.rgba16.size() == numbers);
    }
    for (const Texture& texture : scene.textures) {
        EXPECT_LT(texture.image, static_cast<int>(scene.images.size()));
    }
    for (const double time_s : {0.0, 0.37, 1.0, 1e6, -1.0}) {
        expect_sane_pose(scene, time_s, k_all_animations);
        expect_sane_pose(scene, time_s, default_animation(scene));
    }
}

TEST(Assets, EveryValidSceneLoads) {
    if (!fs::exists(scenes_folder())) {
        GTEST_SKIP() << "no scenes at " << scenes_folder() << "; set BOUNCE_SCENES_DIR";
    }
    const std::map<std::string, std::string> refused{
        {"CesiumBalloonKTX2.glb", "KHR_texture_basisu"},
        {"14_emission_strength.gltf", "KHR_materials_pbrSpecularGlossiness"},
    };
    size_t loaded = 0;
    for (const char* folder :
         {"khronos", "animated", "compressed", "gi-bitterli", "gi-mcguire", "gi-misc", "gi-webxr"}) {
        for (const fs::path& file : gltf_files(scenes_folder() / folder)) {
            SCOPED_TRACE(file.string());
            if (const auto known = refused.find(file.filename().string()); known != refused.end()) {
                EXPECT_TRUE(says(refusal_of(file), known->second));
                continue;
            }
            try {
                const LoadResult result = load_gltf(file);
                expect_sane(result.scene);
                EXPECT_FALSE(evaluate_pose(result.scene, 0.0).draws.empty() && result.scene.lights.empty() &&
                             result.scene.cameras.empty());
                ++loaded;
            } catch (const std::exception& error) {
                ADD_FAILURE() << error.what();
            }
        }
    }
    EXPECT_GT(loaded, 40U);
}

// Draco, quantised and plain versions of one asset are the same surface.
TEST(Assets, CompressedVersionsAgree) {
    if (!fs::exists(scenes_folder())) {
        GTEST_SKIP() << "no scenes at " << scenes_folder() << "; set BOUNCE_SCENES_DIR";
    }
    const fs::path khronos = scenes_folder() / "khronos";
    const std::vector<std::pair<std::string, std::string>> pairs{
        {"CesiumMan/glTF-Binary/CesiumMan.glb", "CesiumMan/glTF-Draco/CesiumMan.gltf"},
        {"RiggedSimple/glTF-Binary/RiggedSimple.glb", "RiggedSimple/glTF-Draco/RiggedSimple.gltf"},
        {"AnimatedMorphCube/glTF-Binary/AnimatedMorphCube.glb",
         "AnimatedMorphCube/glTF-Quantized/AnimatedMorphCube.gltf"}};
    for (const auto& [plain_name, packed_name] : pairs) {
        SCOPED_TRACE(packed_name);
        const Scene plain = load_gltf(khronos / plain_name).scene;
        const Scene packed = load_gltf(khronos / packed_name).scene;
        for (const double time_s : {0.0, 0.8}) {
            const Bounds a = world_bounds(plain, evaluate_pose(plain, time_s));
            const Bounds b = world_bounds(packed, evaluate_pose(packed, time_s));
            // Draco's 11 bits of position are 1/2000 of the extent, and bounds of skins add several.
            EXPECT_NEAR(glm::length(a.low - b.low), 0.0, 0.01 * a.diagonal());
            EXPECT_NEAR(glm::length(a.high - b.high), 0.0, 0.01 * a.diagonal());
        }
    }
}

// Compressed data comes from anywhere too: what the decoders make of damaged bytes must be checked.
TEST(Assets, DamagedCompressedDataDoesNotCrash) {
    if (!fs::exists(scenes_folder())) {
        GTEST_SKIP() << "no scenes at " << scenes_folder() << "; set BOUNCE_SCENES_DIR";
    }
    const std::vector<std::string> folders{
        "khronos/RiggedSimple/glTF-Draco", "khronos/CesiumMan/glTF-Draco",
        "compressed/gltf-pipeline/EXT_meshopt_compression/meshopt-no-fallback"};
    for (const std::string& name : folders) {
        const TemporaryFolder copy;
        fs::copy(scenes_folder() / name, copy.path(), fs::copy_options::recursive);
        const fs::path scene = gltf_files(copy.path()).at(0);
        fs::path data;
        for (const auto& entry : fs::directory_iterator(copy.path())) {
            data = entry.path().extension() == ".bin" ? entry.path() : data;
        }
        ASSERT_FALSE(data.empty()) << name;
        std::ifstream in(data, std::ios::binary);
        const std::vector<uint8_t> whole{std::istreambuf_iterator<char>(in), {}};
        for (unsigned seed = 0; seed < 200; ++seed) {
            SCOPED_TRACE(fmt::format("{} seed {}", name, seed));
            std::mt19937 random(seed);
            std::vector<uint8_t> bytes = whole;
            for (auto flips = 1 + random() % 20; flips > 0; --flips) {
                bytes[random() % bytes.size()] = static_cast<uint8_t>(random());
            }
            copy.write(data.filename().string(), bytes);
            try {
                expect_sane(load_gltf(scene).scene);
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ExitCode::input_refused) << error.what();
            }
        }
    }
}

TEST(Assets, MalformedFilesLoadOrAreRefusedInOneSentence) {
    const fs::path folder = scenes_folder() / "malformed";
    if (!fs::exists(folder)) {
        GTEST_SKIP() << "no malformed files at " << folder << "; set BOUNCE_SCENES_DIR";
    }
    size_t refused = 0;
    for (const fs::path& file : gltf_files(folder)) {
        SCOPED_TRACE(file.string());
        try {
            expect_sane(load_gltf(file).scene);
        } catch (const Error& error) {
            ++refused;
            const std::string message = error.what();
            EXPECT_EQ(error.code(), ExitCode::input_refused);
            EXPECT_TRUE(says(message, file.filename().string())) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }
    EXPECT_GT(refused, 60U);
}

}  // namespace
}  // namespace bounce::scene::test
