// SPDX-License-Identifier: Apache-2.0
//
// An evaluation of two frames of a small scene, with stand-ins for Bounce and Blender.
#pragma once

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "environment.h"
#include "evaluate/evaluation.h"
#include "fake_programs.h"
#include "temporary_folder.h"

namespace bounce::test {

class EvaluateTest : public testing::Test {
  protected:
    EvaluateTest()
        : cache_("XDG_CACHE_HOME", (folder_ / "cache").string()),
          addon_("BOUNCE_ADDON", (folder_ / "addon").string()) {
        std::filesystem::create_directories(folder_ / "addon");
        std::ofstream(folder_ / "addon/export_cli.py") << "#\n";
        std::ofstream(folder_ / "scene.glb") << "the scene";
        write_constant(folder_ / "picture.exr", 0.6F, 8, 4);
        write_constant(folder_ / "cycles.exr", 0.5F, 8, 4);
        options_.scene = folder_ / "scene.glb";
        options_.frames = {1, 24};
        options_.width = 8;
        options_.height = 4;
        options_.reference.spp = 32;
        options_.cycles_spp = {1, 4};
        options_.bounce = fake_bounce(folder_.path());
        options_.source.blender = fake_blender(folder_.path());
        options_.runs = {
            {"Direct", "direct", {"--technique", "direct"}}, {"RSM", "112", {}}, {"RSM", "224", {}}};
    }

    [[nodiscard]] long calls(const std::string& name) const {
        std::ifstream in(folder_ / name);
        return std::count(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>(), '\n');
    }

    // The description of each job that Blender was started with, in order.
    [[nodiscard]] std::vector<std::string> blender_jobs() const {
        std::ifstream in(folder_ / "blender_calls");
        std::vector<std::string> jobs;
        for (std::string line; std::getline(in, line);) jobs.push_back(line);
        return jobs;
    }

    TemporaryFolder folder_;
    Environment cache_;
    Environment addon_;
    EvaluateOptions options_;
};

}  // namespace bounce::test
