// SPDX-License-Identifier: Apache-2.0
//
// Closed rooms whose light is known, by bounces, albedo and what further bounces are drawn from.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/experiments.h"
#include "bench/furnace_room.h"

namespace bounce::bench {
namespace {

// What further bounces are drawn from, and how far the mean of all views may be from the exact one;
// docs/invariance.md says why.
struct Source {
    std::string name;
    BounceSource source;
    double bound;
};
const std::vector<Source> k_sources = {{"points", BounceSource::points, 0.01},
                                       {"irsm", BounceSource::irsm, 0.10},
                                       {"avg", BounceSource::avg, 0.10}};

struct Measured {
    double mean = 0.0;
    double spread = 0.0;   // standard deviation of a pixel over the mean
    double removed = 0.0;  // radiance that the frames report to have been taken by bounding kernels
    size_t not_finite = 0;
};

Measured measure(const BenchInputs& inputs, Renderer& renderer, const scene::Pose& pose, FurnaceShape shape,
                 const Settings& settings) {
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    Measured out;
    const std::vector<CameraView> cameras = furnace_cameras(shape);
    for (const CameraView& camera : cameras) {
        inputs.interrupts.throw_if_interrupted("nothing is written");
        const FrameReport report = renderer.render(pose, camera, settings);
        out.removed += report.removed ? report.removed->removed / static_cast<double>(cameras.size()) : 0.0;
        const Image image = renderer.read_color();
        for (const float value : image.rgb) {
            out.not_finite += std::isfinite(value) ? 0 : 1;
            sum += value;
            squares += static_cast<double>(value) * value;
            count += 1.0;
        }
    }
    out.mean = sum / count;
    out.spread = std::sqrt(std::max(squares / count - out.mean * out.mean, 0.0)) / out.mean;
    return out;
}

}  // namespace

void measure_furnace(const BenchInputs& inputs, BenchReport& report) {
    Settings settings = inputs.settings();
    const int side = inputs.options.width.value_or(inputs.options.quick ? 16 : 32);
    settings.width = settings.height = side;
    settings.measure_removed = true;
    settings.vpls = inputs.options.vpls.value_or(1024);
    settings.bounce_vpls = settings.emitter_vpls = settings.vpls;
    change_setting(report, "size", fmt::format("{0}x{0}, six views", side));
    change_setting(report, "VPLs", fmt::format("{}, as many of each further bounce", settings.vpls));
    change_setting(report, "bounces", "varied");

    const std::vector<float> albedos = inputs.values<float>({0.5F, 0.99F, 0.2F, 0.8F, 0.95F});
    const std::vector<int> bounces = inputs.values<int>({1, 2, 3, 4});
    const std::vector<FurnaceShape> shapes = {FurnaceShape::cube, FurnaceShape::sphere};
    const std::vector<FurnaceLight> lights = {FurnaceLight::emission, FurnaceLight::point};
    Progress progress("bench furnace", static_cast<int>(shapes.size() * lights.size() * albedos.size() *
                                                        k_sources.size() * bounces.size()));
    Table table{.title = "Mean radiance of the walls of closed rooms",
                .note =
                    "removed: what the frame itself says that bounding the lights' kernels takes; spread: "
                    "of single pixels, standard deviation over the mean",
                .columns = {{"room", ""},
                            {"light", ""},
                            {"albedo", ""},
                            {"source", ""},
                            {"bounces", ""},
                            {"expected", "W/(m2 sr)"},
                            {"got", "W/(m2 sr)"},
                            {"deviation", "%"},
                            {"removed", "%"},
                            {"spread", "%"},
                            {"not finite", ""},
                            {"held", ""}},
                .rows = {}};
    for (const FurnaceShape shape : shapes) {
        for (const FurnaceLight light : lights) {
            for (const float albedo : albedos) {
                const Furnace furnace{shape, light, albedo};
                const scene::Scene scene = make_furnace(furnace);
                const scene::Pose pose = scene::evaluate_pose(scene, 0.0);
                Renderer renderer(scene);
                for (const Source& source : k_sources) {
                    for (const int count : bounces) {
                        settings.bounce_source = source.source;
                        settings.bounces = count;
                        const Measured got = measure(inputs, renderer, pose, shape, settings);
                        const double expected = furnace_radiance(furnace, count);
                        const double deviation = got.mean / expected - 1.0;
                        const bool held = got.not_finite == 0 && std::abs(deviation) <= source.bound;
                        report.bounds_broken += held ? 0 : 1;
                        table.rows.push_back({shape == FurnaceShape::cube ? "cube" : "sphere",
                                              light == FurnaceLight::emission ? "emission" : "point",
                                              static_cast<double>(std::round(albedo * 1e4F)) / 1e4,
                                              source.name, static_cast<double>(count), expected, got.mean,
                                              100.0 * deviation, 100.0 * got.removed / expected,
                                              100.0 * got.spread, static_cast<double>(got.not_finite),
                                              held ? "yes" : "NO"});
                        progress.step(fmt::format("albedo {:.2g}, {}, {} bounces: {:+.2f} %", albedo,
                                                  source.name, count, 100.0 * deviation));
                    }
                }
            }
        }
    }
    report.tables = {std::move(table)};
}

}  // namespace bounce::bench
