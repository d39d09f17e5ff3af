// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sweep_axes.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"

namespace bounce {
namespace {

// As many as `bounce render` draws.
constexpr int k_most_bounces = 4;

// A point a value: {"--vpls", value} labelled "256 VPLs".
std::vector<SweepPoint> values(const std::string& option, const std::vector<int>& numbers,
                               const std::string& label_format, std::vector<std::string> before = {},
                               int bounces = SweepPoint::k_as_reference) {
    std::vector<SweepPoint> points;
    points.reserve(numbers.size());
    for (const int number : numbers) {
        std::vector<std::string> arguments = before;
        arguments.insert(arguments.end(), {option, std::to_string(number)});
        points.push_back({fmt::format(fmt::runtime(label_format), number), std::move(arguments), bounces});
    }
    return points;
}

// What costs and what it buys, raised together: lights, their maps, and how many pixels share them.
SweepPoint scale(int vpls, int ism_size, int interleave) {
    return {fmt::format("{} VPLs, maps of {}, {} x {}", vpls, ism_size, interleave, interleave),
            {"--vpls", std::to_string(vpls), "--ism-size", std::to_string(ism_size), "--interleave",
             std::to_string(interleave)}};
}

SweepPoint without_antialiasing(SweepPoint point) {
    point.label += ", not antialiased";
    point.arguments.insert(point.arguments.end(), {"--antialias", "off"});
    return point;
}

}  // namespace

const std::vector<SweepAxis>& sweep_axes() {
    static const std::vector<SweepAxis> axes = {
        {"presets",
         "Presets",
         "settings that belong together: --preset",
         {{"auto", {"--preset", "auto"}},
          {"rsm2005", {"--preset", "rsm2005"}, SweepPoint::k_one},
          {"ism2008", {"--preset", "ism2008"}},
          {"lv2009", {"--preset", "lv2009"}},
          {"lv2009, hybrid", {"--preset", "lv2009", "--shading", "hybrid"}},
          {"avg2012", {"--preset", "avg2012"}}}},
        {"technique",
         "Technique",
         "how light is carried: --technique",
         {{"direct", {"--technique", "direct"}, SweepPoint::k_one},
          {"rsm", {"--technique", "rsm"}, SweepPoint::k_one},
          {"ism", {"--technique", "ism"}}}},
        {"vpls", "VPLs", "virtual point lights of the first bounce: --vpls",
         values("--vpls", {16, 32, 64, 128, 256, 512, 1024, 2048}, "{} VPLs")},
        {"world-vpls", "World lights", "lights at infinity that stand for the world: --world-vpls",
         values("--world-vpls", {0, 64, 256, 1024}, "{} world lights")},
        {"emitter-vpls", "Emitters' lights",
         "virtual point lights that stand for emissive surfaces: --emitter-vpls",
         values("--emitter-vpls", {0, 64, 256, 1024}, "{} emitter lights")},
        {"emitter-panels", "Emissive panels",
         "sides of emissive rectangles that are drawn as area lights: --emitter-panels",
         values("--emitter-panels", {0, 1, 2, 4}, "{} panels")},
        {"points", "Points", "points splatted into each map: --points",
         values("--points", {64, 256, 1024, 4096, 16384}, "{} points")},
        {"ism-size", "Map size", "side of each imperfect shadow map: --ism-size",
         values("--ism-size", {32, 64, 128, 256}, "maps of {}")},
        {"interleave",
         "Interleave",
         "pixels that share the lights: --interleave",
         {{"1 x 1", {"--interleave", "1"}},
          {"2 x 2", {"--interleave", "2"}},
          {"4 x 4", {"--interleave", "4"}},
          {"8 x 8", {"--interleave", "8"}},
          {"16 x 16", {"--interleave", "16"}}}},
        {"bounces",
         "Bounces",
         "bounces of light, against a reference of the most: --bounces",
         {{"1 bounce", {"--technique", "ism"}, 1},
          {"2 bounces", {"--technique", "ism"}, 2},
          {"3 bounces", {"--technique", "ism"}, 3},
          {"4 bounces", {"--technique", "ism"}, 4}}},
        {"bounces-by",
         "Bounces by",
         "what lights of further bounces are drawn from: --bounce-source, --vpl-sampling",
         {{"points", {"--bounce-source", "points"}},
          {"imperfect RSMs", {"--bounce-source", "irsm"}},
          {"grid", {"--bounce-source", "avg"}},
          {"grid, as in 2012", {"--bounce-source", "avg", "--avg-hits", "voxels", "--avg-paths", "fixed"}},
          {"grid, from the lights on", {"--bounce-source", "avg", "--vpl-sampling", "avg"}}}},
        {"visibility",
         "Visibility",
         "what hides the lights: --visibility",
         {{"none", {"--visibility", "none"}},
          {"ism", {"--visibility", "ism"}},
          {"shadow-maps", {"--visibility", "shadow-maps"}},
          {"simplified", {"--visibility", "simplified"}}}},
        {"splat",
         "Splat",
         "how points are splatted: --splat, --pull-push",
         {{"disks", {"--splat", "disks"}},
          {"disks without large triangles", {"--splat", "disks", "--large-triangles", "off"}},
          {"compute", {"--splat", "compute"}},
          {"compute, filled", {"--splat", "compute", "--pull-push", "fill"}},
          {"points, 2008 pull-push", {"--splat", "points", "--pull-push", "paper"}}}},
        {"sampling",
         "Sampling",
         "where in the reflective shadow map lights are taken from: --vpl-sampling, --vpl-importance, "
         "--rsm-pattern",
         {{"drawn by flux", {"--vpl-importance", "flux"}},
          {"drawn by what is seen", {"--vpl-importance", "view"}},
          {"inverse transform, seen", {"--vpl-importance", "view", "--vpl-sampling", "inverse3"}},
          {"Metropolis, seen", {"--vpl-importance", "view", "--vpl-sampling", "metropolis"}},
          {"resampled, seen", {"--vpl-importance", "view", "--vpl-sampling", "resampled"}},
          {"uniform, by Halton", {"--vpl-sampling", "uniform"}},
          {"traced through the grid", {"--vpl-sampling", "avg"}},
          {"uniform radius", {"--technique", "rsm", "--rsm-pattern", "uniform-radius"}, SweepPoint::k_one},
          {"inverse square", {"--technique", "rsm", "--rsm-pattern", "inverse-square"}, SweepPoint::k_one},
          {"the paper's to the letter",
           {"--technique", "rsm", "--rsm-pattern", "paper-literal"},
           SweepPoint::k_one}}},
        {"rsm-samples", "RSM samples", "pixel lights gathered at a pixel: --technique rsm --rsm-samples",
         values("--rsm-samples", {28, 112, 448, 1792}, "{} samples", {"--technique", "rsm"},
                SweepPoint::k_one)},
        {"direct-shadows",
         "Direct shadows",
         "of lights with a size: --direct-shadows, --shadow-samples, --soft-shadow-size",
         {{"hard", {"--direct-shadows", "hard"}},
          {"16 places", {"--shadow-samples", "16"}},
          {"64 places", {"--shadow-samples", "64"}},
          {"128 places", {"--shadow-samples", "128"}},
          {"64 places, maps of 256", {"--shadow-samples", "64", "--soft-shadow-size", "256"}},
          {"256 places, imperfect maps", {"--direct-shadows", "ism", "--shadow-samples", "256"}}}},
        {"antialias",
         "Antialiasing",
         "outlines smoothed as by Cycles' pixel filter, or not: --antialias",
         {{"on", {"--antialias", "on"}}, {"off", {"--antialias", "off"}}}},
        {"scale",
         "Scale",
         "VPLs, map size and interleave together, from coarse to fine; the coarsest without antialiasing",
         {without_antialiasing(scale(32, 32, 8)), without_antialiasing(scale(64, 32, 8)), scale(32, 32, 8),
          scale(64, 32, 8), scale(128, 32, 4), scale(256, 32, 8), scale(512, 32, 4), scale(1024, 64, 8),
          scale(2048, 64, 4), scale(1024, 128, 2)}},
        {"converge",
         "Convergence",
         "seconds that a frame may take: --converge --time-limit",
         {{"0.1 s", {"--converge", "--time-limit", "0.1"}},
          {"0.3 s", {"--converge", "--time-limit", "0.3"}},
          {"1 s", {"--converge", "--time-limit", "1"}},
          {"3 s", {"--converge", "--time-limit", "3"}},
          {"10 s", {"--converge", "--time-limit", "10"}},
          {"30 s", {"--converge", "--time-limit", "30"}}},
         false},
        {"guard",
         "Guard",
         "a cheap point of each path through the renderer, for --baseline",
         {{"direct", {"--technique", "direct"}, SweepPoint::k_one},
          {"rsm", {"--technique", "rsm", "--rsm-samples", "112"}, SweepPoint::k_one},
          {"disks", {"--vpls", "64"}},
          {"none", {"--vpls", "64", "--visibility", "none"}},
          // One bounce: a map a light is drawn from triangles, and those of further bounces are many.
          {"shadow-maps",
           {"--vpls", "16", "--visibility", "shadow-maps", "--ism-size", "32"},
           SweepPoint::k_one},
          {"compute, filled", {"--vpls", "64", "--splat", "compute", "--pull-push", "fill"}},
          {"points, 2008 pull-push", {"--vpls", "64", "--splat", "points", "--pull-push", "paper"}}},
         false},
    };
    return axes;
}

std::string sweep_axis_names() {
    std::string names;
    for (const SweepAxis& axis : sweep_axes()) {
        names += (names.empty() ? "" : ", ") + axis.name;
    }
    return names;
}

std::vector<PreviewRun> sweep_runs(const std::vector<std::string>& names, int bounces) {
    if (bounces < 1) {
        throw usage_error(
            "--sweep needs --bounces 1 or more; without bounced light there is nothing to vary");
    }
    const auto named = [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const std::string& name : names) {
        if (name != "all" && std::none_of(sweep_axes().begin(), sweep_axes().end(),
                                          [&](const SweepAxis& axis) { return axis.name == name; })) {
            throw usage_error(fmt::format("--sweep {}: there is no such axis; there are {}, and all", name,
                                          sweep_axis_names()));
        }
    }
    if (named("bounces") && bounces < 2) {
        throw usage_error(
            "--sweep bounces needs --bounces 2 or more: all its points are compared with one reference, "
            "which "
            "has the most bounces");
    }
    if (named("bounces-by") && bounces < 2) {
        throw usage_error(
            "--sweep bounces-by needs --bounces 2 or more: what it varies is of further bounces");
    }
    std::vector<PreviewRun> runs;
    for (const SweepAxis& axis : sweep_axes()) {
        const bool of_further = axis.name == "bounces" || axis.name == "bounces-by";
        const bool in_all = axis.part_of_all && (!of_further || bounces > 1);
        if (!named(axis.name) && !(named("all") && in_all)) {
            continue;
        }
        for (const SweepPoint& point : axis.points) {
            if (point.bounces > bounces) {
                continue;
            }
            PreviewRun run{axis.title, point.label, point.arguments};
            const int drawn = point.bounces == SweepPoint::k_as_reference ? std::min(bounces, k_most_bounces)
                                                                          : point.bounces;
            if (drawn > 1) {
                run.render_arguments.insert(run.render_arguments.end(), {"--bounces", std::to_string(drawn)});
            }
            runs.push_back(std::move(run));
        }
    }
    return runs;
}

}  // namespace bounce
