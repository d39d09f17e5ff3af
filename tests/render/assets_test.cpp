// SPDX-License-Identifier: Apache-2.0
//
// Models from elsewhere: every one loads, or is refused for a known reason, and is seen. They are not part of
// the project; $BOUNCE_SCENES_DIR says where they are, and without them the tests are skipped.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include "core/error.h"
#include "render_fixture.h"
#include "scene/gltf_loader.h"

namespace bounce::test {
namespace {

namespace fs = std::filesystem;

constexpr int k_width = 96;
constexpr int k_height = 54;

// By file name, with what the refusal must say.
const std::map<std::string, std::string> k_refused = {
    {"14_emission_strength.gltf", "KHR_materials_pbrSpecularGlossiness"},
    {"CesiumBalloonKTX2.glb", "KHR_texture_basisu"},
};

fs::path scenes_folder() {
    const char* folder = std::getenv("BOUNCE_SCENES_DIR");
    return folder != nullptr ? fs::path(folder) : fs::path(BOUNCE_SOURCE_DIR) / ".." / "shared" / "scenes";
}

std::vector<fs::path> models_in(const fs::path& folder) {
    std::vector<fs::path> models;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        const fs::path extension = entry.path().extension();
        if (entry.is_regular_file() && (extension == ".glb" || extension == ".gltf")) {
            models.push_back(entry.path());
        }
    }
    std::sort(models.begin(), models.end());
    return models;
}

Settings small_settings() {
    Settings settings;
    settings.width = k_width;
    settings.height = k_height;
    settings.rsm_samples = 16;
    settings.rsm_size = 64;
    settings.shadow_size = 256;
    // Whether files load and are seen takes few lights; how many are enough is measured elsewhere.
    settings.world_vpls = settings.emitter_vpls = settings.vpls = 32;
    settings.shadow_samples = 8;
    settings.soft_shadow_size = 128;
    return settings;
}

Image render(Renderer& renderer, const scene::Scene& scene, const scene::Pose& pose) {
    renderer.render(pose, scene_camera(scene, pose, {}, k_width, k_height), small_settings());
    Image image = renderer.read_color();
    EXPECT_TRUE(
        std::all_of(image.rgb.begin(), image.rgb.end(), [](float value) { return std::isfinite(value); }));
    return image;
}

double mean(const Image& image) {
    double sum = 0.0;
    for (const float value : image.rgb) {
        sum += static_cast<double>(value);
    }
    return sum / static_cast<double>(image.rgb.size());
}

// Pixels that show a surface: those that a sun behind the camera's shoulder lights, in a black world.
int covered_pixels(Renderer& renderer, const scene::Scene& scene, scene::Pose pose) {
    pose.world.color = glm::vec3(0.0F);
    scene::Light sun;
    sun.type = scene::LightType::sun;
    sun.irradiance_w_m2 = 10.0F;
    sun.cast_shadow = false;
    pose.lights = {sun};
    pose.light_instances = {{0, 0, scene_camera(scene, pose, {}, k_width, k_height).world_from_camera}};
    const Image image = render(renderer, scene, pose);
    int count = 0;
    for (size_t i = 0; i < image.rgb.size(); i += 3) {
        count += std::max({image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]}) > 0.0F ? 1 : 0;
    }
    return count;
}

struct Outcome {
    int coverage = 0;
    bool black = true;
};

Outcome render_at_two_times(const scene::Scene& scene) {
    Outcome outcome;
    Renderer renderer(scene);
    const int animation = scene::default_animation(scene);
    const double duration = animation >= 0 && static_cast<size_t>(animation) < scene.animations.size()
                                ? scene.animations[static_cast<size_t>(animation)].duration_s
                                : 1.0;
    for (const double time : {0.0, 0.37 * duration}) {
        const scene::Pose pose = scene::evaluate_pose(scene, time, animation);
        outcome.black &= mean(render(renderer, scene, pose)) <= 0.0;
        outcome.coverage = std::max(outcome.coverage, covered_pixels(renderer, scene, pose));
    }
    return outcome;
}

// One-sided surfaces that face down, seen from above.
const std::set<std::string> k_unseen = {"22_vertex_color.gltf"};

class Assets : public ::testing::TestWithParam<const char*> {
  protected:
    void SetUp() override { require_context(); }
};

TEST_P(Assets, LoadAndAreSeen) {
    const fs::path folder = scenes_folder() / GetParam();
    if (!fs::exists(folder)) {
        GTEST_SKIP() << "no models in " << folder << "; set BOUNCE_SCENES_DIR";
    }
    for (const fs::path& path : models_in(folder)) {
        SCOPED_TRACE(fs::relative(path, folder).string());
        const std::string name = path.filename().string();
        const auto refused = k_refused.find(name);
        try {
            const scene::LoadResult loaded = scene::load_gltf(path);
            EXPECT_EQ(refused, k_refused.end()) << "loads now: take it off the list of refused files";
            const Outcome outcome = render_at_two_times(loaded.scene);
            EXPECT_EQ(outcome.coverage > 20, !k_unseen.contains(name))
                << outcome.coverage << " pixels show a surface";
            EXPECT_FALSE(outcome.black);
        } catch (const Error& error) {
            if (refused == k_refused.end()) {
                ADD_FAILURE() << error.what();
            } else {
                EXPECT_NE(std::string(error.what()).find(refused->second), std::string::npos) << error.what();
                EXPECT_EQ(error.code(), ExitCode::input_refused);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Folders, Assets,
                         ::testing::Values("animated", "compressed", "gi-bitterli", "gi-mcguire", "gi-misc",
                                           "gi-webxr", "khronos"),
                         [](const auto& folder) {
                             std::string name = folder.param;
                             std::erase(name, '-');
                             return name;
                         });

// Files with one fault each: refused in a sentence that names the file, or drawn; never anything else.
TEST(FaultyAssets, AreRefusedByNameOrDrawn) {
    require_context();
    const fs::path folder = scenes_folder() / "malformed";
    if (!fs::exists(folder)) {
        GTEST_SKIP() << "no models in " << folder << "; set BOUNCE_SCENES_DIR";
    }
    int drawn = 0;
    int refused = 0;
    for (const fs::path& path : models_in(folder)) {
        SCOPED_TRACE(fs::relative(path, folder).string());
        try {
            const scene::LoadResult loaded = scene::load_gltf(path);
            render_at_two_times(loaded.scene);
            ++drawn;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::input_refused) << error.what();
            EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos)
                << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            ++refused;
        } catch (const std::exception& error) {
            ADD_FAILURE() << "neither drawn nor refused: " << error.what();
        }
    }
    EXPECT_GT(drawn, 20);
    EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace bounce::test
