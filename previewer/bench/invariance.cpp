// SPDX-License-Identifier: Apache-2.0
//
// Pictures of scenes told in other numbers, against the picture of the scene as it is.
#include <utility>

#include <fmt/format.h>

#include "bench/experiments.h"
#include "bench/scene_changes.h"
#include "renderer/presets.h"

namespace bounce::bench {
namespace {

struct Setup {
    std::string name;
    Settings settings;
};

// What is told by the scene beside the defaults: another technique, and another light.
std::vector<Setup> setups(const BenchInputs& inputs) {
    const Settings standard = inputs.settings();
    Settings rsm = preset_settings(Preset::rsm2005);
    rsm.width = standard.width;
    rsm.height = standard.height;
    Settings two = standard;
    two.direct_shadows = DirectShadows::convolution;
    two.bounces = 2;
    return {{"default", standard}, {"rsm2005", rsm}, {"convolution, 2 bounces", two}};
}

class Pictures {
  public:
    Pictures(const BenchInputs& inputs, const scene::Scene& scene)
        : inputs_(inputs),
          scene_(scene),
          pose_(scene::evaluate_pose(scene, scene::time_of_frame(scene.frames, inputs.frame_of(scene)),
                                     scene::default_animation(scene))),
          renderer_(scene) {}
    // seed 0: the picture of a frame by itself.
    Image draw(const Settings& settings, uint32_t seed = 0) {
        inputs_.interrupts.throw_if_interrupted("nothing is written");
        const CameraView camera =
            scene_camera(scene_, pose_, inputs_.options.camera, settings.width, settings.height);
        if (seed == 0) {
            renderer_.render(pose_, camera, settings);
            return renderer_.read_color();
        }
        renderer_.render_one_of_many(pose_, camera, settings, gl::TimingMode::off, 1, 1.0F);
        renderer_.render_one_of_many(pose_, camera, settings, gl::TimingMode::off, seed + 1, 1.0F);
        return renderer_.read_color();
    }

  private:
    const BenchInputs& inputs_;
    const scene::Scene& scene_;
    scene::Pose pose_;
    Renderer renderer_;
};

}  // namespace

void measure_invariance(const BenchInputs& inputs, BenchReport& report) {
    const std::vector<Setup> all_setups = inputs.values(setups(inputs));
    const std::vector<SceneChange> changes = inputs.values(scene_changes());
    Progress progress("bench invariance",
                      static_cast<int>(inputs.scenes.size() * (changes.size() + 1) * all_setups.size()));
    Table table{.title = "Pictures of changed scenes against those of the scenes as they are",
                .note = fmt::format("worst: |a - b| / (|b| + a hundredth of the mean), over pixels and "
                                    "channels; changed: pixels where it is above {:g}; seeds: relMSE of "
                                    "pictures that differ in their seed alone",
                                    k_visible),
                .columns = {{"scene", ""},
                            {"settings", ""},
                            {"change", ""},
                            {"worst", ""},
                            {"changed", "%"},
                            {"bias", "%"},
                            {"relMSE", ""},
                            {"bound", ""},
                            {"seeds", ""},
                            {"not finite", ""},
                            {"held", ""}},
                .rows = {}};
    for (const scene::Scene& scene : inputs.scenes) {
        std::vector<Image> references;
        std::vector<double> own_errors;
        {
            Pictures pictures(inputs, scene);
            for (const Setup& setup : all_setups) {
                references.push_back(pictures.draw(setup.settings));
                own_errors.push_back(difference(pictures.draw(setup.settings, 1), references.back()).relmse);
                progress.step(fmt::format("{}, {}", scene.name, setup.name));
            }
        }
        for (const SceneChange& change : changes) {
            const scene::Scene changed = change.apply(scene);
            Pictures pictures(inputs, changed);
            for (size_t s = 0; s < all_setups.size(); ++s) {
                const Difference d =
                    difference(pictures.draw(all_setups[s].settings), references[s], change.light);
                const double bound = relmse_bound(change.allowed, own_errors[s]);
                const bool held = d.not_finite == 0 && d.relmse <= bound;
                report.bounds_broken += held ? 0 : 1;
                table.rows.push_back({scene.name, all_setups[s].name, change.name, d.worst, 100.0 * d.changed,
                                      100.0 * d.bias, d.relmse, bound, own_errors[s],
                                      static_cast<double>(d.not_finite), held ? "yes" : "NO"});
                progress.step(fmt::format("{}, {}, {}: relMSE {:.2g}", scene.name, all_setups[s].name,
                                          change.name, d.relmse));
            }
        }
    }
    report.tables = {std::move(table)};
}

}  // namespace bounce::bench
