// SPDX-License-Identifier: Apache-2.0
//
// What splats cost by each path, over their number and the mesh's size: Table 3 and Figure 10 of Barak,
// Bittner and Havran 2013, "Temporally Coherent Adaptive Sampling for Imperfect Shadow Maps".
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "bench/experiments.h"
#include "bench/room.h"
#include "renderer/settings_check.h"
#include "scene/primitive_bounds.h"
#include "scene/refine.h"

namespace bounce::bench {
namespace {

constexpr int k_maps = 1024;  // as in the paper, in an atlas of 2048 x 2048 texels
constexpr int k_map_size = 64;

constexpr std::array k_paths = {Splat::points, Splat::compute, Splat::disks, Splat::tessellation};
constexpr size_t k_tessellation = 3;

struct PaperRow {
    double splats;
    // Milliseconds by stored points, by tessellation, and the ratio it prints: Armadillo, Crytek-Sponza,
    // Conference, Sibenik.
    std::array<double, 12> values;
};
constexpr std::array<PaperRow, 10> k_paper = {
    {{10e3, {0.36, 2.42, 0.15, 0.25, 1.21, 0.21, 0.31, 1.40, 0.22, 0.39, 0.56, 0.69}},
     {100e3, {1.66, 2.45, 0.67, 1.34, 2.14, 0.62, 1.90, 2.42, 0.78, 1.81, 2.05, 0.88}},
     {250e3, {3.55, 2.41, 1.48, 2.71, 2.89, 0.94, 3.61, 3.62, 1.00, 3.20, 2.85, 1.12}},
     {500e3, {5.43, 2.37, 2.30, 4.84, 3.49, 1.39, 5.36, 3.95, 1.36, 5.31, 4.55, 1.17}},
     {1e6, {8.69, 3.84, 2.26, 8.78, 4.63, 1.90, 8.80, 4.84, 1.82, 9.83, 7.38, 1.33}},
     {2e6, {17.32, 5.35, 3.24, 17.30, 6.52, 2.65, 16.79, 6.95, 2.42, 18.56, 13.35, 1.39}},
     {4e6, {34.28, 13.25, 2.59, 34.30, 11.23, 3.05, 33.67, 11.42, 2.95, 34.88, 24.06, 1.45}},
     {8e6, {68.56, 25.87, 2.65, 68.29, 18.74, 3.64, 66.90, 18.82, 3.55, 68.17, 43.94, 1.55}},
     {16e6, {136.58, 52.12, 2.62, 136.70, 33.03, 4.14, 133.10, 32.55, 4.09, 136.18, 75.71, 1.80}},
     {32e6, {272.93, 107.25, 2.54, 272.42, 55.20, 4.94, 266.13, 55.54, 4.79, 274.88, 119.40, 2.30}}}};

struct NamedScene {
    std::string name;
    scene::Scene scene;
};

// The scene's spheres or whatever it has, pulsing: every vertex has a morph target.
scene::Scene deforming(scene::Scene scene) {
    for (scene::Mesh& mesh : scene.meshes) {
        for (scene::Primitive& primitive : mesh.primitives) {
            if (primitive.indices.size() / 3 < 100 || !primitive.targets.empty()) {
                continue;  // walls stand still
            }
            scene::MorphTarget grown;
            for (const glm::vec3& normal : primitive.normals) {
                grown.positions.push_back(0.05F * normal);
            }
            primitive.targets = {std::move(grown)};
            primitive.bounds = scene::primitive_bounds(primitive);
        }
    }
    for (scene::Node& node : scene.nodes) {
        if (node.mesh != scene::k_none &&
            !scene.meshes[static_cast<size_t>(node.mesh)].primitives.front().targets.empty() &&
            node.weights.empty()) {
            node.weights = {0.5F};
        }
    }
    return scene;
}

std::vector<NamedScene> scenes(const BenchInputs& inputs) {
    if (inputs.options.generated) {
        std::vector<NamedScene> out;
        for (const auto& [name, segments] : inputs.values<std::pair<const char*, int>>(
                 {{"small mesh", 16}, {"medium mesh", 64}, {"large mesh", 176}})) {
            out.push_back({name, make_room(segments)});
        }
        return out;
    }
    NamedScene split{"the scene, triangles split", inputs.scene};
    scene::refine_scene(split.scene, scene::refinement_by(8.0));
    return {{"the scene", inputs.scene}, std::move(split)};
}

// Points a map for so many splats in all; none where a map cannot have as few or as many.
std::vector<int> point_counts(const BenchInputs& inputs, int maps, BenchReport& report) {
    if (inputs.options.points) {
        return {*inputs.options.points};
    }
    std::vector<int> out;
    for (const double splats : inputs.values<double>({10e3, 100e3, 250e3, 500e3, 1e6, 2e6, 4e6, 8e6})) {
        const auto points = static_cast<int>(splats / maps + 0.5);
        if (splats > inputs.options.most_splats) {
            continue;
        }
        if (points >= 1 && points <= k_most_points_a_map) {
            out.push_back(points);
        } else {
            report.notes.push_back(
                fmt::format("{} splats in {} maps are not measured: a map takes 1 to {} points",
                            format_number(splats), maps, k_most_points_a_map));
        }
    }
    return out;
}

// What a path took with fewer splats, and what it is not measured with: --longest.
class Patience {
  public:
    Patience(std::optional<double> longest_s, std::string path)
        : longest_ms_(longest_s ? *longest_s * 1e3 : std::numeric_limits<double>::infinity()),
          path_(std::move(path)) {}

    // Whether so many splats are measured. A path's time grows with them at least as their number, once there
    // are many; where it does not yet, the expectation is too high, so it is taken from the growth that was
    // seen where there are two times.
    [[nodiscard]] bool allows(double splats) {
        if (splats_ <= 0.0 || !left_out_.empty()) {
            return left_out_.empty();
        }
        const double more = splats / splats_;
        const double growth = grew_ > 0.0 ? std::pow(more, std::max(grew_, 0.0)) : more;
        const double expected = ms_ * growth;
        if (expected <= longest_ms_) {
            return true;
        }
        left_out_ = fmt::format("{} from {} splats on, expected to take {:.1f} s", path_,
                                format_number(splats), 1e-3 * expected);
        return false;
    }
    void took(double splats, double ms) {
        if (splats_ > 0.0 && splats > splats_ && ms_ > 0.0) {
            grew_ = std::log(ms / ms_) / std::log(splats / splats_);
        }
        splats_ = splats;
        ms_ = ms;
    }
    [[nodiscard]] const std::string& left_out() const { return left_out_; }

  private:
    double longest_ms_;
    std::string path_;
    double splats_ = 0.0;
    double ms_ = 0.0;
    double grew_ = 0.0;  // exponent of the last step
    std::string left_out_;
};

// Of what is splatted and, of points that move, moved; without pull-push.
Samples splat_time(const MeasuredFrame& measured) {
    return measured.sum([](const MeasuredPass& pass) {
        return pass.part == Part::maps && pass.name.find("pull-push") == std::string::npos;
    });
}

Table measure_table(FrameBench& bench, const BenchInputs& inputs, const std::string& name, Settings settings,
                    const std::vector<int>& counts, Progress& progress, std::vector<Series>& series) {
    Table table{.title = fmt::format("Splat times, {}", name),
                .note = "",
                .columns = {{"splats", ""},
                            {"points", "ms"},
                            {"compute", "ms"},
                            {"disks", "ms"},
                            {"tessellation", "ms"},
                            {"points over it", "times"},
                            {"compute over it", "times"},
                            {"disks over it", "times"}},
                .rows = {}};
    for (const Splat path : k_paths) {
        series.push_back({fmt::format("{}, {}", splat_name(path), name), {}});
    }
    std::vector<Patience> patience;
    for (const Splat path : k_paths) {
        patience.emplace_back(inputs.options.longest_s, splat_name(path));
    }
    size_t triangles = 0;
    for (const int points : counts) {
        settings.ism_points = points;
        // The lights that a frame draws are those asked for, to a few that subsets need.
        double splats = static_cast<double>(settings.vpls) * points;
        std::array<std::optional<double>, k_paths.size()> ms{};
        for (size_t i = 0; i < k_paths.size(); ++i) {
            if (!patience[i].allows(splats)) {
                progress.step(
                    fmt::format("{}, {} splats, {}: left out", name, splats, splat_name(k_paths[i])));
                continue;
            }
            settings.splat = k_paths[i];
            const MeasuredFrame measured = bench.measure(settings, inputs.repeat(), Measure::passes);
            ms[i] = splat_time(measured).best();
            triangles = measured.report.triangles;
            splats = static_cast<double>(measured.report.vpls) * points;
            patience[i].took(splats, *ms[i]);
            series[series.size() - k_paths.size() + i].points.push_back({splats, *ms[i]});
            progress.step(
                fmt::format("{}, {} splats, {}: {:.1f} ms", name, splats, splat_name(k_paths[i]), *ms[i]));
        }
        std::vector<Cell> row{splats};
        for (const std::optional<double>& time : ms) {
            row.push_back(time ? Cell(*time) : Cell());
        }
        for (size_t i = 0; i < k_tessellation; ++i) {
            row.push_back(ms[i] && ms[k_tessellation] ? Cell(*ms[i] / *ms[k_tessellation]) : Cell());
        }
        table.rows.push_back(std::move(row));
    }
    std::string left_out;
    for (const Patience& path : patience) {
        if (!path.left_out().empty()) {
            left_out += (left_out.empty() ? "" : "; ") + path.left_out();
        }
    }
    if (!left_out.empty()) {
        left_out = fmt::format("Left out by --longest {:g}: {}. ", *inputs.options.longest_s, left_out);
    }
    table.note = fmt::format("{} triangles. {}", triangles, left_out);
    return table;
}

void add_paper(BenchReport& report) {
    Table table{.title = "Table 3 of Barak et al. 2013",
                .note = "Stored points, tessellation and the ratio of the two, without pull-push.",
                .columns = {{"splats", ""}},
                .rows = {}};
    for (const char* scene : {"Armadillo", "Sponza", "Conference", "Sibenik"}) {
        table.columns.push_back({fmt::format("{}, points", scene), "ms"});
        table.columns.push_back({"tessellation", "ms"});
        table.columns.push_back({"ratio", "times"});
    }
    for (const PaperRow& row : k_paper) {
        std::vector<Cell> cells{row.splats};
        cells.insert(cells.end(), row.values.begin(), row.values.end());
        table.rows.push_back(std::move(cells));
    }
    report.tables.push_back(std::move(table));
    report.paper = {
        "Barak et al. 2013 (Core i7-3770, GeForce GTX 470), section 6.3: \"Our approach is 2 to 5 times "
        "faster "
        "than using the preprocessed points.\"",
        "Section 6.4: it \"can actually be slower if the number of generated splats is lower than the total "
        "number of scene triangles\".",
        "Its stored points are splatted by GL_POINTS; each picks a map at random, as our tessellated ones "
        "do, "
        "while maps of stored points of ours have a block of the sequence each."};
}

}  // namespace

void measure_splat_paths(const BenchInputs& inputs, BenchReport& report) {
    Settings settings = inputs.settings();
    settings.vpls = inputs.options.vpls.value_or(k_maps);
    settings.ism_size = inputs.options.ism_size.value_or(k_map_size);
    // Only the maps are timed, and all of the scene is in them.
    settings.width = inputs.options.width.value_or(64);
    settings.height = inputs.options.height.value_or(36);
    settings.large_triangles = false;
    settings.drop_hull = false;
    settings.world_vpls = settings.emitter_vpls = 0;
    change_setting(report, "size", fmt::format("{}x{}", settings.width, settings.height));
    change_setting(report, "VPLs", std::to_string(settings.vpls));
    change_setting(report, "splat", "varied");
    if (!inputs.options.points) {
        change_setting(report, "points a map", "varied");
    }
    const std::vector<NamedScene> all = scenes(inputs);
    const std::vector<int> counts = point_counts(inputs, settings.vpls, report);
    Progress progress("bench ism-splats",
                      static_cast<int>((all.size() + 1) * counts.size() * k_paths.size()));
    Plot plot{.title = "Time to splat",
              .note = "Without pull-push.",
              .kind = Plot::Kind::lines,
              .x_label = "splats in all maps",
              .y_label = "milliseconds",
              .x_log = true,
              .y_log = true,
              .series = {},
              .bar_names = {}};
    for (const NamedScene& item : all) {
        FrameBench bench = inputs.bench(item.scene);
        report.tables.push_back(
            measure_table(bench, inputs, item.name, settings, counts, progress, plot.series));
        report.tables.back().note += "Without pull-push; clearing included.";
    }
    const NamedScene& moved = all[std::min<size_t>(all.size() - 1, inputs.options.generated ? 1 : 0)];
    const scene::Scene deforms = deforming(moved.scene);
    FrameBench bench = inputs.bench(deforms);
    report.tables.push_back(
        measure_table(bench, inputs, moved.name + ", deforming", settings, counts, progress, plot.series));
    report.tables.back().note +=
        "Every mesh of 100 triangles or more morphs: stored points are moved with it in each frame, which "
        "their times include; tessellation has none to move.";
    Series paper_points{"paper, Sponza, points", {}, true};
    Series paper_made{"paper, Sponza, tessellation", {}, true};
    for (const PaperRow& row : k_paper) {
        paper_points.points.push_back({row.splats, row.values[3]});
        paper_made.points.push_back({row.splats, row.values[4]});
    }
    plot.series.push_back(std::move(paper_points));
    plot.series.push_back(std::move(paper_made));
    report.plots.push_back(std::move(plot));
    add_paper(report);
    report.notes.emplace_back(
        "beyond 4 M splats stored points are shared by maps: 64 MiB hold no more (renderer/ism_layout.cpp)");
}

}  // namespace bounce::bench
