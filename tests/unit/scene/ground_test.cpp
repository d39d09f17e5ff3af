// SPDX-License-Identifier: Apache-2.0
//
// The plane under a scene and what stands on it.
#include "scene/points/ground.h"

#include <gtest/gtest.h>

#include "made_scenes.h"
#include "scene/points/hull.h"

namespace bounce::scene::test {
namespace {

struct Found {
    SurfaceParts parts;
    Ground ground;
    [[nodiscard]] bool node(int index) const {
        for (size_t i = 0; i < parts.surfaces.size(); ++i) {
            if (parts.surfaces[i].node == index) {
                return ground.surfaces[i];
            }
        }
        ADD_FAILURE() << "no surface of node " << index;
        return false;
    }
};

Found find(const Scene& scene) {
    Found found{surface_parts(scene, k_all_animations), {}};
    const Pose pose = evaluate_pose(scene, 0.0);
    HullFinder finder(scene, found.parts);
    found.ground = find_ground(scene, pose, found.parts, finder.on_hull(pose));
    return found;
}

TEST(Ground, IsTheWidestPlaneOnTheHullAndTheRestStandsOnIt) {
    Scene scene;
    const int ground = place_mesh(scene, add_mesh(scene, square(100.0F)), moved({20.0, 0.0, 0.0}));
    const int tile = place_mesh(scene, add_mesh(scene, square(10.0F)), moved({-3.0, 0.0, 0.0}));
    const int object = place_mesh(scene, add_mesh(scene, triangle_soup(40, 2)), moved({0.0, 0.0, 1.5}));
    const Found found = find(scene);
    EXPECT_TRUE(found.node(ground));
    EXPECT_TRUE(found.node(tile)) << "in the same plane";
    EXPECT_FALSE(found.node(object));
    Scene alone;
    place_mesh(alone, add_mesh(alone, triangle_soup(40, 2)), moved({0.0, 0.0, 1.5}));
    const Bounds expected = world_bounds(alone, evaluate_pose(alone, 0.0));
    EXPECT_LT(glm::distance(found.ground.rest.low, expected.low), 1e-9);
    EXPECT_LT(glm::distance(found.ground.rest.high, expected.high), 1e-9);
}

TEST(Ground, OnceItCutsThroughTheSceneThereIsNone) {
    Scene scene;
    const int ground = place_mesh(scene, add_mesh(scene, square(100.0F)), glm::dmat4(1.0));
    place_mesh(scene, add_mesh(scene, triangle_soup(40, 2)), moved({0.0, 0.0, 1.5}));
    place_mesh(scene, add_mesh(scene, triangle_soup(40, 3)), moved({5.0, 0.0, -1.5}));
    const Found found = find(scene);
    EXPECT_FALSE(found.node(ground));
    EXPECT_NEAR(found.ground.rest.high.x - found.ground.rest.low.x, 100.0, 1e-3);
}

TEST(Ground, AloneItIsTheScene) {
    Scene scene;
    const int ground = place_mesh(scene, add_mesh(scene, square(100.0F)), glm::dmat4(1.0));
    const Found found = find(scene);
    EXPECT_FALSE(found.node(ground)) << "there is nothing else to take apart from it";
    EXPECT_NEAR(found.ground.rest.diagonal(), 100.0 * std::sqrt(2.0), 1e-3);
}

}  // namespace
}  // namespace bounce::scene::test
