// SPDX-License-Identifier: Apache-2.0
//
// Skins, morph targets and key frames that are long, out of range or few.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "stress/stress.h"

namespace bounce::stress {
namespace {

using nlohmann::json;

constexpr double pi = std::numbers::pi;
const glm::vec3 k_color(0.7F, 0.3F, 0.2F);
constexpr Tolerance k_same_corners{0.1, 0.01};

// Ground, a lamp and a camera; what moves is added.
SceneFile stage() {
    SceneFile file;
    file.place(ground(3.0F), file.material(glm::vec3(0.8F)));
    file.light({{"type", "point"}, {"power_w", 60.0}, {"radius_m", 0.0}},
               glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, 1.5, 0.7)));
    file.camera({0.3, 1.6, 2.2}, {0.0, 0.2, 0.0});
    return file;
}

SceneFile stage_with(const Geometry& geometry) {
    SceneFile file = stage();
    file.place(geometry, file.material(k_color));
    return file;
}

constexpr int k_bones = 200;

// A strip of k_bones squares, standing on its edge; row i of corners belongs to bone i.
Geometry strip(const glm::dmat4* row_matrix) {
    Geometry out;
    for (int i = 0; i <= k_bones; ++i) {
        const int bone = std::min(i, k_bones - 1);
        const double x = 0.01 * (i - bone);
        for (const double y : {0.1, 0.6}) {
            out.positions.emplace_back(glm::vec3(row_matrix[bone] * glm::dvec4(x, y, 0.0, 1.0)));
        }
    }
    for (uint32_t i = 0; i < k_bones; ++i) {
        out.indices.insert(out.indices.end(), {2 * i, 2 * i + 2, 2 * i + 3, 2 * i, 2 * i + 3, 2 * i + 1});
    }
    return out;
}

Verdict long_chain(StressRun& run) {
    // Each bone turns by 1.7 degrees against its parent and lies a centimetre farther: most of a circle.
    const glm::dquat turn = glm::angleAxis(1.7 * pi / 180.0, glm::dvec3(0.0, 1.0, 0.0));
    const glm::dmat4 bone =
        glm::translate(glm::dmat4(1.0), glm::dvec3(0.01, 0.0, 0.0)) * glm::mat4_cast(turn);
    std::vector<glm::dmat4> bent = {glm::dmat4(1.0)};
    std::vector<glm::dmat4> straight = {glm::dmat4(1.0)};
    for (int i = 1; i < k_bones; ++i) {
        bent.push_back(bent.back() * bone);
        straight.push_back(glm::translate(glm::dmat4(1.0), glm::dvec3(0.01 * i, 0.0, 0.0)));
    }
    SceneFile file = stage();
    const Geometry rest = strip(straight.data());
    std::vector<uint16_t> joints;
    std::vector<float> weights;
    for (int i = 0; i <= k_bones; ++i) {
        for (int k = 0; k < 2; ++k) {
            joints.insert(joints.end(), {static_cast<uint16_t>(std::min(i, k_bones - 1)), 0, 0, 0});
            weights.insert(weights.end(), {1.0F, 0.0F, 0.0F, 0.0F});
        }
    }
    const json attributes = {
        {"attributes",
         {{"JOINTS_0", file.accessor(joints, "VEC4")}, {"WEIGHTS_0", file.accessor(weights, "VEC4")}}}};
    const int of_mesh = file.mesh(rest, file.material(k_color), attributes);
    std::vector<float> inverse;
    json bones = json::array();
    int parent = -1;
    for (int i = 0; i < k_bones; ++i) {
        const glm::dmat4 joint_from_mesh = glm::inverse(straight[static_cast<size_t>(i)]);
        for (int k = 0; k < 16; ++k) {
            inverse.push_back(static_cast<float>(joint_from_mesh[k / 4][k % 4]));
        }
        json description = {{"name", "bone"}};
        if (i > 0) {
            description["translation"] = {0.01, 0.0, 0.0};
            description["rotation"] = {turn.x, turn.y, turn.z, turn.w};
        }
        const int index = i == 0 ? file.node(description) : file.add("nodes", description);
        if (parent >= 0) {
            file.root["nodes"][static_cast<size_t>(parent)]["children"] = {index};
        }
        parent = index;
        bones.push_back(index);
    }
    const int skin =
        file.add("skins", {{"joints", bones}, {"inverseBindMatrices", file.accessor(inverse, "MAT4")}});
    file.node({{"mesh", of_mesh}, {"skin", skin}});
    return same(run.draw(file).image, run.draw(stage_with(strip(bent.data()))).image, k_same_corners);
}

Geometry block() {
    return box({-0.3F, 0.1F, -0.3F}, {0.3F, 0.7F, 0.3F});
}

// The block with two morph targets: one moves it up, one to the side.
SceneFile morphing(const std::vector<double>& weights) {
    SceneFile file = stage();
    const Geometry rest = block();
    std::vector<float> up;
    std::vector<float> aside;
    for (size_t i = 0; i < rest.positions.size(); ++i) {
        up.insert(up.end(), {0.0F, 0.2F, 0.0F});
        aside.insert(aside.end(), {0.1F, 0.0F, 0.0F});
    }
    const json targets = {
        {"targets",
         {{{"POSITION", file.accessor(up, "VEC3")}}, {{"POSITION", file.accessor(aside, "VEC3")}}}}};
    const int of_mesh = file.mesh(rest, file.material(k_color), targets);
    file.root["meshes"][static_cast<size_t>(of_mesh)]["weights"] = weights;
    file.place(of_mesh);
    return file;
}

Verdict weights_outside(StressRun& run) {
    const glm::dvec3 by(0.1 * 5.0, 0.2 * -0.5, 0.0);
    return same(run.draw(morphing({-0.5, 5.0})).image,
                run.draw(stage_with(block().moved(glm::translate(glm::dmat4(1.0), by)))).image,
                k_same_corners);
}

// The block moved by key frames along X.
SceneFile keyed(const std::vector<float>& times, const std::vector<float>& along_x) {
    SceneFile file = stage();
    const int node = file.place(block(), file.material(k_color));
    file.root["nodes"][static_cast<size_t>(node)].erase("matrix");
    std::vector<float> places;
    for (const float x : along_x) {
        places.insert(places.end(), {x, 0.0F, 0.0F});
    }
    file.add("animations",
             {{"samplers",
               {{{"input", file.accessor(times, "SCALAR")}, {"output", file.accessor(places, "VEC3")}}}},
              {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}}}});
    return file;
}

Verdict keyed_at(StressRun& run, const SceneFile& file, double frame, float expected_x) {
    const glm::dvec3 by(static_cast<double>(expected_x), 0.0, 0.0);
    return same(run.draw(file, StressRun::settings(), frame).image,
                run.draw(stage_with(block().moved(glm::translate(glm::dmat4(1.0), by)))).image,
                k_same_corners);
}

Verdict keys_at_one_time(StressRun& run) {
    // At 0.5 s it jumps; just behind, the later key counts.
    const SceneFile file = keyed({0.0F, 0.5F, 0.5F, 1.0F}, {0.0F, 0.0F, 0.5F, 0.5F});
    return both(keyed_at(run, file, 6.0, 0.5F), keyed_at(run, file, 5.9, 0.0F));
}

Verdict all_keys_at_one_time(StressRun& run) {
    return keyed_at(run, keyed({0.5F, 0.5F, 0.5F}, {0.1F, 0.2F, 0.4F}), 3.0, 0.4F);
}

Verdict one_key(StressRun& run) {
    const SceneFile file = keyed({0.3F}, {0.4F});
    return both(keyed_at(run, file, 1.0, 0.4F), keyed_at(run, file, 9.0, 0.4F));
}

Verdict beyond_the_keys(StressRun& run) {
    const SceneFile file = keyed({0.2F, 0.4F}, {0.3F, -0.3F});
    return both(keyed_at(run, file, -1e6, 0.3F), keyed_at(run, file, 1e6, -0.3F));
}

Verdict keys_back_in_time(StressRun& run) {
    return refused(run, keyed({0.5F, 0.1F}, {0.0F, 0.4F}), ExitCode::input_refused, {"back in time"},
                   StressRun::settings());
}

}  // namespace

std::vector<StressCase> motion_cases() {
    constexpr const char* k_same =
        "as the same corners at rest: worst 10 % of bounced light's noise, mean 1 %";
    return {
        {"a chain of 200 bones", k_same, long_chain},
        {"morph weights -0.5 and 5", k_same, weights_outside},
        {"two keys at the same time", k_same, keys_at_one_time},
        {"all keys at the same time", k_same, all_keys_at_one_time},
        {"one key only", k_same, one_key},
        {"times a million frames beyond the keys", k_same, beyond_the_keys},
        {"keys that go back in time", "refused: the sampler is named, exit code 3", keys_back_in_time},
    };
}

}  // namespace bounce::stress
