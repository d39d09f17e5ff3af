// SPDX-License-Identifier: Apache-2.0
//
// Lights chosen one by one and the near field: what lights leave out near themselves it puts back, whatever
// the sampler.
#include <cmath>

#include "ism_fixture.h"
#include "renderer/converge.h"
#include "renderer/setting_names.h"

namespace bounce::test {
namespace {

TEST(VplSize, TheNearFieldPutsBackWhatChosenLightsLeaveOut) {
    require_context();
    scene::Scene scene = corner_scene();
    add_mesh_node(scene, add_square(scene, 24.0F, add_diffuse(scene)), moved({0.0, 0.0, -0.01}));
    add_light(scene, light_of(scene::LightType::sun), rotated(55.0, {0.0, 1.0, 0.0}, {1.0, 0.2, 2.0}));
    Settings full = bounced(48);
    full.technique = Technique::rsm;
    full.rsm_full_sum = true;
    full.rsm_size = 512;
    const double reference = draw(scene, floor_camera(), full).mean();
    for (const VplSampling sampling :
         {VplSampling::inverse_transform, VplSampling::uniform3, VplSampling::inverse3,
          VplSampling::metropolis, VplSampling::metropolis_single, VplSampling::resampled}) {
        Settings settings = bounced(48);
        settings.rsm_size = 512;
        settings.visibility = Visibility::none;
        settings.vpls = 512;
        settings.vpl_sampling = sampling;
        settings.vpl_importance = Importance::view;
        settings.importance_pixels = 2.0F;
        settings.vpl_steps = 10;
        const double off = draw(scene, floor_camera(), settings).mean() / reference - 1.0;
        // One wall in 36 times its floor: of even proposals few find it. Weights by the first proposal
        // alone have ten times the spread of the others; sizes that followed them would darken it by 30
        // %.
        EXPECT_LT(std::abs(off), sampling == VplSampling::metropolis_single ? 0.2 : 0.06)
            << name_of(sampling);
    }
}

// Of ground that is hardly seen a cell's texel counts for little and stands for much; it must not stand for
// the cell's others, which are seen.
TEST(VplImportance, CellsConvergeToWhatSingleTexelsDo) {
    require_context();
    scene::Scene scene = corner_scene();
    add_mesh_node(scene, add_square(scene, 120.0F, add_diffuse(scene)), moved({0.0, 0.0, -0.01}));
    add_light(scene, light_of(scene::LightType::sun), rotated(55.0, {0.0, 1.0, 0.0}, {1.0, 0.2, 2.0}));
    const auto mean = [&](VplSampling sampling) {
        Settings settings = bounced(32);
        settings.visibility = Visibility::none;
        settings.vpls = 64;
        settings.vpl_sampling = sampling;
        settings.vpl_importance = Importance::view;
        Renderer renderer(scene);
        const CameraView camera = floor_camera();
        const Image picture = converge(renderer, {scene::evaluate_pose(scene, 0.0), camera}, settings,
                                       {.passes = 8}, gl::TimingMode::off, {})
                                  .picture;
        double sum = 0.0;
        for (const float value : picture.rgb) {
            sum += static_cast<double>(value);
        }
        return sum;
    };
    // 8 %: noise of 8 passes of 64 lights.
    EXPECT_NEAR(mean(VplSampling::inverse_transform) / mean(VplSampling::inverse3), 1.0, 0.08);
}

// A surface in a few pixels of the picture is looked at as often as one that fills it.
TEST(VplImportance, LooksAtWhatIsSeenHoweverSmall) {
    require_context();
    scene::Scene scene = corner_scene();
    add_light(scene, light_of(scene::LightType::spot), rotated(25.0, {0.0, 1.0, 0.0}, {0.5, 0.2, 3.0}));
    Settings settings = bounced(64);
    settings.vpls = 256;
    settings.interleave = 1;
    settings.visibility = Visibility::none;
    CameraView far = floor_camera();
    far.camera.xmag *= 16.0F;  // four pixels of the 64 across
    far.camera.ymag *= 16.0F;
    const double expected = draw(scene, far, settings).mean();
    ASSERT_GT(expected, 0.0);
    settings.vpl_importance = Importance::view;
    settings.importance_floor = 0.0F;
    settings.vpl_sampling = VplSampling::inverse3;
    // A third: a few pixels, and lights that are bounded otherwise as they lie elsewhere.
    EXPECT_NEAR(draw(scene, far, settings).mean() / expected, 1.0, 0.33);
}

}  // namespace
}  // namespace bounce::test
