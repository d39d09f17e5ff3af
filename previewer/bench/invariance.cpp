// SPDX-License-Identifier: Apache-2.0
//
// Pictures of scenes told in other numbers, against the picture of the scene as it is.
#include <algorithm>
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

// The largest error of as many pictures with other seeds is the picture's own. Where lights are drawn from
// points few pictures have a light right beside a wall, and those few are far from all others.
constexpr uint32_t k_seeds = 3;
constexpr uint32_t k_seeds_of_redrawn = 8;

// Whether a frame drew lights of a further bounce, the world's or emitters' included.
bool draws_from_points(const FrameReport& report) {
    return std::any_of(report.executed.begin(), report.executed.end(), [](const std::string& pass) {
        return pass.starts_with("vpls") && pass.find("bounce") != std::string::npos;
    });
}

std::vector<SceneChange> wanted_changes(const BenchInputs& inputs) {
    if (inputs.options.changes.empty()) {
        return inputs.values(scene_changes());
    }
    std::vector<SceneChange> out;
    for (const std::string& name : inputs.options.changes) {
        out.push_back(scene_change(name));
    }
    return out;
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
    Image draw(const Settings& settings, uint32_t seed = 0, FrameReport* report = nullptr) {
        inputs_.interrupts.throw_if_interrupted("nothing is written");
        const CameraView camera =
            scene_camera(scene_, pose_, inputs_.options.camera, settings.width, settings.height);
        if (seed == 0) {
            FrameReport drawn = renderer_.render(pose_, camera, settings);
            if (report != nullptr) *report = std::move(drawn);
            return renderer_.read_color();
        }
        if (settings.technique == Technique::rsm) {  // the pattern of another number of samples
            Settings other = settings;
            other.rsm_samples += static_cast<int>(seed) * 7;
            renderer_.render(pose_, camera, other);
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
    const std::vector<SceneChange> changes = wanted_changes(inputs);
    Progress progress("bench invariance",
                      static_cast<int>(inputs.scenes.size() * (changes.size() + 1) * all_setups.size()));
    Table table{.title = "Pictures of changed scenes against those of the scenes as they are",
                .note = fmt::format("worst: |a - b| / (|b| + a hundredth of the mean), over pixels and "
                                    "channels; changed: pixels where it is above {:g}; seeds: the largest "
                                    "relMSE of some pictures that differ in their seed alone",
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
        std::vector<bool> redrawn;
        {
            Pictures pictures(inputs, scene);
            for (const Setup& setup : all_setups) {
                FrameReport drawn;
                references.push_back(pictures.draw(setup.settings, 0, &drawn));
                redrawn.push_back(draws_from_points(drawn));
                double& own = own_errors.emplace_back(0.0);
                for (uint32_t seed = 1; seed <= (redrawn.back() ? k_seeds_of_redrawn : k_seeds); ++seed) {
                    own = std::max(own,
                                   difference(pictures.draw(setup.settings, seed), references.back()).relmse);
                }
                progress.step(fmt::format("{}, {}", scene.name, setup.name));
            }
        }
        for (const SceneChange& change : changes) {
            const scene::Scene changed = change.apply(scene);
            Pictures pictures(inputs, changed);
            for (size_t s = 0; s < all_setups.size(); ++s) {
                const Difference d =
                    difference(pictures.draw(all_setups[s].settings), references[s], change.light);
                const double bound = relmse_bound(change.allowed, own_errors[s], redrawn[s]);
                const bool held = holds(d, change.allowed, own_errors[s], redrawn[s]);
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
