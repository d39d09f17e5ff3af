// SPDX-License-Identifier: Apache-2.0
#include "stress/stress.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/stopwatch.h"
#include "renderer/presets.h"
#include "scene/gltf_loader.h"
#include "scene/pose.h"

namespace bounce::stress {
namespace {

constexpr double k_no_bias = std::numeric_limits<double>::quiet_NaN();

double mean_of(const Image& image) {
    double sum = 0.0;
    for (const float value : image.rgb) {
        sum += static_cast<double>(value);
    }
    return sum / static_cast<double>(std::max<size_t>(image.rgb.size(), 1));
}

bool is_finite(const Image& image) {
    return std::all_of(image.rgb.begin(), image.rgb.end(), [](float value) { return std::isfinite(value); });
}

std::string percent(double share) {
    return fmt::format("{:.2g} %", 100.0 * share);
}

// The other ways to draw, each of which takes other passes.
std::vector<Settings> other_techniques(const Settings& base) {
    std::vector<Settings> out;
    const auto add = [&](auto change) {
        Settings with = base;
        change(with);
        out.push_back(with);
    };
    add([](Settings& s) { s.technique = Technique::rsm; });
    add([](Settings& s) {
        s.bounces = 3;
        s.bounce_source = BounceSource::irsm;
        s.splat = Splat::compute;
        s.pull_push = PullPush::paper;
    });
    add([](Settings& s) {
        s.bounces = 2;
        s.bounce_source = BounceSource::avg;
        s.vpl_sampling = VplSampling::avg;
        s.avg_size = 32;
    });
    add([](Settings& s) {
        s.visibility = Visibility::simplified;
        s.shading = Shading::hybrid;
        s.vpls = 16;
        s.world_vpls = 16;
        s.vpl_sampling = VplSampling::metropolis;
        s.vpl_importance = Importance::view;
        s.direct_shadows = DirectShadows::convolution;
    });
    add([](Settings& s) {
        s.direct_shadows = DirectShadows::ism;
        s.shadow_samples = 16;
        s.soft_shadow_size = 64;
        s.temporal_reuse = true;
        s.antialias = true;
    });
    return out;
}

}  // namespace

glm::dvec3 Picture::at(int x, int y) const {
    const size_t i = image.offset(x, y);
    return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
}

double Picture::mean() const {
    return mean_of(image);
}

StressRun::StressRun(std::filesystem::path folder, Size size, bool every_technique)
    : folder_(std::move(folder)), size_(size), every_technique_(every_technique) {}

Settings StressRun::settings() {
    Settings out;
    out.width = 48;
    out.height = 32;
    out.vpls = 64;
    out.bounce_vpls = 64;
    out.world_vpls = 64;
    out.emitter_vpls = 64;
    out.ism_size = 32;
    out.rsm_size = 64;
    out.shadow_size = 512;
    out.shadow_samples = 16;
    out.soft_shadow_size = 128;
    out.antialias = false;
    out.check_finite = true;
    out.find_unlit = true;
    return out;
}

Picture StressRun::draw(const SceneFile& file, const Settings& with, double frame) {
    const std::filesystem::path path = folder_ / fmt::format("stress {}.glb", files_++);
    file.write(path);
    scene::LoadResult loaded;
    try {
        loaded = scene::load_gltf(path);
    } catch (...) {
        std::filesystem::remove(path);
        throw;
    }
    std::filesystem::remove(path);
    const scene::Scene& scene = loaded.scene;
    const scene::Pose pose = scene::evaluate_pose(scene, scene::time_of_frame(scene.frames, frame),
                                                  scene::default_animation(scene));
    Renderer renderer(scene);
    const auto draw_with = [&](const Settings& settings) {
        return renderer.render(pose, scene_camera(scene, pose, "", settings.width, settings.height),
                               settings);
    };
    Picture out;
    out.report = draw_with(with);
    out.image = renderer.read_color();
    out.warnings = loaded.warnings;
    if (every_technique_) {
        for (const Settings& other : other_techniques(with)) {
            (void)draw_with(other);
        }
    }
    return out;
}

Verdict same(const Image& got, const Image& expected, const Tolerance& tolerance) {
    if (got.width != expected.width || got.height != expected.height) {
        return {false, fmt::format("{}x{} pixels", got.width, got.height), k_no_bias};
    }
    const double mean = mean_of(expected);
    const double bias = mean_of(got) / mean - 1.0;
    double worst = 0.0;
    size_t at = 0;
    for (size_t i = 0; i < got.rgb.size(); ++i) {
        const double reference = static_cast<double>(expected.rgb[i]);
        const double error =
            std::abs(static_cast<double>(got.rgb[i]) - reference) / std::max(std::abs(reference), mean);
        if (error > worst) {
            worst = error;
            at = i / 3;
        }
    }
    const bool fits =
        is_finite(got) && mean > 0.0 && worst <= tolerance.worst && std::abs(bias) <= tolerance.mean;
    const auto width = static_cast<size_t>(got.width);
    std::string text = fmt::format("worst {}, mean {}", percent(worst), percent(bias));
    if (!fits) {
        text += fmt::format("; worst at ({}, {}): {:.4g} for {:.4g}", at % width, at / width, got.rgb[3 * at],
                            expected.rgb[3 * at]);
    }
    return {fits, text, bias};
}

Verdict even(const Image& got, const glm::dvec3& value, const Tolerance& tolerance) {
    Image expected(got.width, got.height);
    for (size_t i = 0; i < expected.rgb.size(); ++i) {
        expected.rgb[i] = static_cast<float>(value[static_cast<int>(i % 3)]);
    }
    return same(got, expected, tolerance);
}

Verdict black_with_note(const Picture& got) {
    const bool black =
        std::all_of(got.image.rgb.begin(), got.image.rgb.end(), [](float value) { return value == 0.0F; });
    if (!black) {
        return {false, fmt::format("not black: mean {:.4g}", got.mean()), k_no_bias};
    }
    if (got.report.notes.empty()) {
        return {false, "black, and nothing says why", k_no_bias};
    }
    return {true, "black: " + got.report.notes.front(), k_no_bias};
}

Verdict at_most(const Picture& got, const Picture& lit, double share) {
    const double leak = got.mean() / lit.mean();
    const bool fits = is_finite(got.image) && lit.mean() > 0.0 && leak <= share;
    return {fits, fmt::format("{} of the light", percent(leak)), k_no_bias};
}

Verdict both(const Verdict& a, const Verdict& b) {
    return {a.as_expected && b.as_expected, a.got + "; " + b.got,
            std::isnan(a.bias) || std::abs(b.bias) > std::abs(a.bias) ? b.bias : a.bias};
}

Verdict refused(StressRun& run, const SceneFile& file, ExitCode code, const std::vector<std::string>& words,
                const Settings& with) {
    try {
        (void)run.draw(file, with);
    } catch (const Error& error) {
        const std::string said = error.what();
        const bool fits = error.code() == code &&
                          std::all_of(words.begin(), words.end(),
                                      [&](const auto& word) { return said.find(word) != std::string::npos; });
        return {fits, fmt::format("refused ({}): {}", static_cast<int>(error.code()), said), k_no_bias};
    }
    return {false, "not refused", k_no_bias};
}

std::vector<StressCase> stress_cases() {
    std::vector<StressCase> out;
    for (const std::vector<StressCase>& cases :
         {light_cases(), geometry_cases(), surface_cases(), motion_cases(), picture_cases()}) {
        out.insert(out.end(), cases.begin(), cases.end());
    }
    return out;
}

StressResult run_case(const StressCase& of, StressRun& run) {
    const Stopwatch watch;
    StressResult out;
    try {
        out.verdict = of.run(run);
    } catch (const std::exception& error) {
        const std::string said = error.what();
        out.finite = said.find(" wrote ") == std::string::npos;
        out.verdict = {false, said, k_no_bias};
    }
    out.seconds = watch.ms() / 1e3;
    return out;
}

}  // namespace bounce::stress
