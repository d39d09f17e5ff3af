// SPDX-License-Identifier: Apache-2.0
//
// Preset auto within a time a frame, against every other preset and its own standard: time and error of each,
// which of those that keep to the time is the most exact, and whether that is auto.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/experiments.h"
#include "core/error.h"
#include "core/stopwatch.h"
#include "image/image_io.h"
#include "image/metrics.h"
#include "renderer/auto_trial.h"
#include "renderer/converge.h"
#include "renderer/presets.h"

namespace bounce::bench {
namespace {

// Without a reference of Cycles': seconds for one of our own.
constexpr double k_reference_s = 20.0;
constexpr double k_quick_reference_s = 1.0;
// What takes so many times the largest budget is not timed again: it does not fit, whatever disturbed it. The
// very first frame has shaders to compile.
constexpr double k_hopeless = 3.0;
constexpr double k_hopeless_at_first = 10.0;
// Within so much of the best error counts as being it.
constexpr double k_near = 1.1;

struct Size {
    int width = 0;
    int height = 0;
    [[nodiscard]] std::string text() const { return fmt::format("{}x{}", width, height); }
    bool operator==(const Size&) const = default;
};

struct Contestant {
    Contestant(std::string called, const Settings& drawn) : name(std::move(called)), settings(drawn) {}
    std::string name;
    Settings settings;
    std::optional<double> budget_ms;  // auto's
    std::string options;              // what auto chose
    Samples time;
    Metrics error;
};

struct Truth {
    Image picture;
    std::string source;
};

// {scene} and {size} of a pattern put in.
std::string reference_path(std::string pattern, const std::string& scene, const std::string& size) {
    for (const auto& [field, value] :
         {std::pair<std::string, std::string>{"{scene}", scene}, {"{size}", size}}) {
        for (size_t at = pattern.find(field); at != std::string::npos; at = pattern.find(field)) {
            pattern.replace(at, field.size(), value);
        }
    }
    return pattern;
}

class SceneBench {
  public:
    SceneBench(const BenchInputs& inputs, const scene::Scene& scene)
        : inputs_(inputs),
          scene_(scene),
          animation_(scene::default_animation(scene)),
          frame_(inputs.options.frame.value_or(scene.frames.start)),
          pose_(scene::evaluate_pose(scene, scene::time_of_frame(scene.frames, frame_), animation_)),
          renderer_(scene) {}

    [[nodiscard]] CameraView camera(const Size& size) const {
        return scene_camera(scene_, pose_, inputs_.options.camera, size.width, size.height);
    }
    [[nodiscard]] std::string stem() const { return std::filesystem::path(scene_.name).stem().string(); }

    // Of one bounce, as all contestants draw. A picture of our own where no file is given.
    Truth truth(const Size& size, const AutoScene& described) {
        if (!inputs_.options.references.empty()) {
            const std::string path = reference_path(inputs_.options.references, stem(), size.text());
            // The scene may be an export of the reference's: their hashes differ, which the file's name does
            // not.
            Image picture = read_scene_linear(path);
            if (picture.width != size.width || picture.height != size.height) {
                throw input_error(fmt::format("the reference {} is {}x{}, not {}", path, picture.width,
                                              picture.height, size.text()));
            }
            const ImageAttributes header = read_attributes(path);
            const auto spp = header.find("bounce:spp");
            return {std::move(picture),
                    spp == header.end() ? path
                                        : fmt::format("Cycles, {} samples a pixel ({})", spp->second, path)};
        }
        AutoRequest request;
        request.base = sized(Settings{}, size);
        Settings settings = choose_settings(described, request).settings;
        settings.vpls = 1024;
        const double seconds = inputs_.options.quick ? k_quick_reference_s : k_reference_s;
        Converged converged = converge(renderer_, {pose_, camera(size)}, settings,
                                       ConvergeTarget{.seconds = seconds}, gl::TimingMode::off, nullptr);
        return {std::move(converged.picture),
                fmt::format("our own mean of {} frames of {} VPLs", converged.state.passes, settings.vpls)};
    }

    [[nodiscard]] AutoScene described(const Size& size) const {
        return describe_scene(scene_, animation_, inputs_.options.camera, size.width, size.height);
    }

    Contestant automatic(const AutoScene& described, const Size& size, double budget_ms, AutoTrial& trial) {
        AutoRequest request;
        request.base = sized(Settings{}, size);
        request.budget_ms = budget_ms;
        const Moment moment{pose_, camera(size)};
        trial = choose_on_trial(renderer_, std::span(&moment, 1), described, request);
        Contestant out(fmt::format("auto, {:g} ms", budget_ms), trial.choice.settings);
        out.budget_ms = budget_ms;
        for (const AutoReason& reason : trial.choice.reasons) {
            out.options += (out.options.empty() || reason.choice.empty() ? "" : " ") + reason.choice;
        }
        return out;
    }

    static Settings sized(Settings settings, const Size& size) {
        settings.width = size.width;
        settings.height = size.height;
        settings.bounces = 1;  // the reference's
        return settings;
    }

    double draw(const Contestant& contestant, const Size& size) {
        inputs_.interrupts.throw_if_interrupted("nothing is written");
        const CameraView view = camera(size);
        glFinish();
        const Stopwatch watch;
        (void)renderer_.render(pose_, view, contestant.settings);
        glFinish();
        return watch.ms();
    }
    // Times change as others' work on the machine does: each round times all, so that all see the same.
    void measure(std::vector<Contestant>& all, const Size& size, const Truth& truth, double longest_ms,
                 Progress& progress) {
        const DisplayedImage shown = displayed(truth.picture);
        for (Contestant& contestant : all) {
            const double first_ms = draw(contestant, size);
            if (first_ms > k_hopeless_at_first * longest_ms) {
                contestant.time.ms.push_back(first_ms);
            }
            const Image picture = renderer_.read_color();
            contestant.error = compare(picture, displayed(picture), truth.picture, shown, HdrFlip::leave_out);
            progress.step(fmt::format("{} {} {}: relMSE {:.2g}", stem(), size.text(), contestant.name,
                                      contestant.error.relmse));
        }
        for (int round = 0; round < inputs_.repeat(); ++round) {
            for (Contestant& contestant : all) {
                if (contestant.time.best() > k_hopeless * longest_ms) {
                    continue;
                }
                // The one before may have left other textures and maps behind.
                (void)draw(contestant, size);
                contestant.time.ms.push_back(draw(contestant, size));
            }
        }
    }

  private:
    const BenchInputs& inputs_;
    const scene::Scene& scene_;
    int animation_;
    int frame_;
    scene::Pose pose_;
    Renderer renderer_;
};

std::vector<Contestant> presets(const AutoScene& described, const Size& size) {
    std::vector<Contestant> out;
    AutoRequest request;
    request.base = SceneBench::sized(Settings{}, size);
    out.emplace_back("auto, no budget", choose_settings(described, request).settings);
    for (const auto& [name, preset] : preset_names()) {
        if (preset != Preset::automatic) {
            out.emplace_back(name, SceneBench::sized(preset_settings(preset), size));
        }
    }
    return out;
}

// How auto did within a budget.
struct Verdict {
    std::string text;
    bool met = false;
};

Verdict judge(const std::vector<Contestant>& all, double budget_ms) {
    const auto fits = [&](const Contestant& one) { return one.time.median() <= budget_ms; };
    const Contestant* best = nullptr;
    const Contestant* own = nullptr;
    for (const Contestant& one : all) {
        if (one.budget_ms && *one.budget_ms != budget_ms) {
            continue;
        }
        own = one.budget_ms ? &one : own;
        if (fits(one) && (best == nullptr || one.error.relmse < best->error.relmse)) {
            best = &one;
        }
    }
    if (best == nullptr) {
        const auto fastest = std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
            return a.time.median() < b.time.median();
        });
        const bool cheapest = own->time.median() <= k_near * fastest->time.median();
        return {cheapest ? "nothing fits; auto is the fastest" : "nothing fits", cheapest};
    }
    if (!fits(*own)) {
        return {fmt::format("auto does not keep to it; {} is best", best->name), false};
    }
    if (own->error.relmse <= best->error.relmse) {
        return {"auto is best", true};
    }
    return {fmt::format("{} is best; auto has {:.3g} times its error", best->name,
                        own->error.relmse / best->error.relmse),
            own->error.relmse <= k_near * best->error.relmse};
}

std::vector<Size> sizes_of(const BenchOptions& options) {
    std::vector<Size> out;
    for (size_t i = 0; i < options.budgets_ms.size(); ++i) {
        const auto& [width, height] = options.sizes.empty()
                                          ? std::pair{options.width.value_or(96), options.height.value_or(54)}
                                          : options.sizes[std::min(i, options.sizes.size() - 1)];
        out.push_back({width, height});
    }
    return out;
}

}  // namespace

void measure_auto_budgets(const BenchInputs& inputs, BenchReport& report) {
    const BenchOptions& options = inputs.options;
    if (options.sizes.size() > 1 && options.sizes.size() != options.budgets_ms.size()) {
        throw usage_error(fmt::format("--sizes has {} sizes for {} budgets; give one, or one a budget",
                                      options.sizes.size(), options.budgets_ms.size()));
    }
    const std::vector<Size> sizes = sizes_of(options);
    std::vector<Size> distinct;
    for (const Size& size : sizes) {
        if (std::find(distinct.begin(), distinct.end(), size) == distinct.end()) {
            distinct.push_back(size);
        }
    }
    Table summary{
        .title = "Is auto best",
        .note = "Of all that keep to the budget in the median, by relMSE.",
        .columns =
            {{"scene", ""}, {"budget", "ms"}, {"size", ""}, {"auto", "ms"}, {"relMSE", ""}, {"verdict", ""}},
        .rows = {}};
    Table chosen{.title = "What auto chose",
                 .note = "The machine's speed is against the one that auto's times are of (docs/auto.md).",
                 .columns = {{"scene", ""}, {"budget", "ms"}, {"speed", "times"}, {"settings", ""}},
                 .rows = {}};
    int met = 0;
    Progress progress("bench auto",
                      static_cast<int>(inputs.scenes.size() * (6 * distinct.size() + sizes.size())));
    for (const scene::Scene& scene : inputs.scenes) {
        SceneBench bench(inputs, scene);
        for (const Size& size : distinct) {
            const AutoScene described = bench.described(size);
            const Truth truth = bench.truth(size, described);
            std::vector<Contestant> all = presets(described, size);
            double longest_ms = 0.0;
            for (size_t i = 0; i < sizes.size(); ++i) {
                if (sizes[i] == size) {
                    AutoTrial trial;
                    all.push_back(bench.automatic(described, size, options.budgets_ms[i], trial));
                    longest_ms = std::max(longest_ms, options.budgets_ms[i]);
                    chosen.rows.push_back(
                        {bench.stem(), options.budgets_ms[i], trial.machine_speed, all.back().options});
                }
            }
            bench.measure(all, size, truth, longest_ms, progress);
            Table table{.title = fmt::format("{}, {}", bench.stem(), size.text()),
                        .note = fmt::format("Errors against {}; one bounce.", truth.source),
                        .columns = {{"settings", ""},
                                    {"median", "ms"},
                                    {"least", "ms"},
                                    {"relMSE", ""},
                                    {"FLIP", ""},
                                    {"bias", "%"}},
                        .rows = {}};
            for (const Contestant& one : all) {
                table.rows.push_back({one.name, one.time.median(), one.time.best(), one.error.relmse,
                                      one.error.flip_ldr, 100.0 * one.error.bias});
            }
            report.tables.push_back(std::move(table));
            for (const Contestant& one : all) {
                if (one.budget_ms) {
                    const Verdict verdict = judge(all, *one.budget_ms);
                    met += verdict.met ? 1 : 0;
                    summary.rows.push_back({bench.stem(), *one.budget_ms, size.text(), one.time.median(),
                                            one.error.relmse, verdict.text});
                }
            }
        }
    }
    const double asked = static_cast<double>(inputs.scenes.size() * sizes.size());
    report.tables.push_back(std::move(summary));
    report.tables.push_back(std::move(chosen));
    report.checks.push_back({"scenes and budgets where auto is best or within 10 % of the best",
                             static_cast<double>(met), Check::Kind::at_least, asked, ""});
}

}  // namespace bounce::bench
