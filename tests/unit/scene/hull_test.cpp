// SPDX-License-Identifier: Apache-2.0
//
// Which surfaces lie on the scene's hull, by hand and by what that means: no line between two places of the
// scene passes through them.
#include "scene/points/hull.h"

#include <gtest/gtest.h>

#include "made_scenes.h"

namespace bounce::scene::test {
namespace {

struct Found {
    SurfaceParts parts;
    std::vector<bool> on_hull;
    // Whether all parts of a node are on the hull, or none of them; a mixture fails.
    [[nodiscard]] bool node(int index) const {
        int yes = 0;
        int all = 0;
        for (size_t i = 0; i < parts.parts.size(); ++i) {
            if (parts.surfaces[parts.parts[i].surface].node == index) {
                yes += on_hull[i] ? 1 : 0;
                ++all;
            }
        }
        EXPECT_GT(all, 0) << "node " << index;
        EXPECT_TRUE(yes == 0 || yes == all) << "node " << index;
        return yes > 0;
    }
};

Found find(const Scene& scene) {
    Found found{surface_parts(scene, k_all_animations), {}};
    HullFinder finder(scene, found.parts);
    found.on_hull = finder.on_hull(evaluate_pose(scene, 0.0));
    EXPECT_EQ(found.on_hull.size(), found.parts.parts.size());
    return found;
}

// A wall of side 4 whose middle is `at` and whose normal is along an axis.
int add_wall(Scene& scene, int axis, double at, double tilt = 0.0) {
    const glm::dvec3 turn = axis == 0 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    glm::dvec3 place(0.0);
    place[axis] = at;
    const double angle = axis == 2 ? 0.0 : 0.5 * pi;
    return place_mesh(scene, add_mesh(scene, square(4.0F)),
                      turned(tilt) * moved(place) * glm::rotate(glm::dmat4(1.0), angle, turn));
}

TEST(Hull, WallsOfAClosedRoomAreOnItAndADividerIsNot) {
    for (const double tilt : {0.0, 0.7}) {
        Scene scene;
        for (int axis = 0; axis < 3; ++axis) {
            for (const double at : {-2.0, 2.0}) {
                add_wall(scene, axis, at, tilt);
            }
        }
        const int divider = add_wall(scene, 0, 0.5, tilt);
        const int object =
            place_mesh(scene, add_mesh(scene, triangle_soup(40, 1)), turned(tilt) * scaled(glm::dvec3(0.7)));
        const Found found = find(scene);
        for (int wall = 0; wall < 6; ++wall) {
            EXPECT_TRUE(found.node(wall)) << wall;
        }
        EXPECT_FALSE(found.node(divider));
        EXPECT_FALSE(found.node(object));
    }
}

TEST(Hull, GroundUnderObjectsIsOnIt) {
    Scene scene;
    const int ground = add_wall(scene, 2, 0.0);
    const int object = place_mesh(scene, add_mesh(scene, triangle_soup(40, 2)), moved({0.0, 0.0, 1.5}));
    Found found = find(scene);
    EXPECT_TRUE(found.node(ground));
    EXPECT_FALSE(found.node(object));
    // Below the ground something is hidden by it.
    scene.nodes[static_cast<size_t>(object)].matrix = moved({0.0, 0.0, -0.5});
    found = find(scene);
    EXPECT_FALSE(found.node(ground));
}

TEST(Hull, FeetMaySinkInALittle) {
    // A thousandth of the diagonal is let through. Ground 4 by 4, box of side 1: the diagonal is 5.7.
    Scene scene;
    const int ground = add_wall(scene, 2, 0.0);
    const int object = place_mesh(scene, add_mesh(scene, box(glm::vec3(0.5F))), moved({0.0, 0.0, 0.497}));
    EXPECT_TRUE(find(scene).node(ground));
    scene.nodes[static_cast<size_t>(object)].matrix = moved({0.0, 0.0, 0.49});
    EXPECT_FALSE(find(scene).node(ground));
}

TEST(Hull, OfABoxItselfIsAllOfIt) {
    // Turned, then scaled unevenly: normals go by the cofactor matrix.
    for (const glm::dvec3& scale : {glm::dvec3(1.0), glm::dvec3(1.0, 3.0, 0.4), glm::dvec3(-1.0, 1.0, 2.0)}) {
        Scene scene;
        const int object =
            place_mesh(scene, add_mesh(scene, box({1.0F, 2.0F, 0.5F})), scaled(scale) * turned(1.1));
        EXPECT_TRUE(find(scene).node(object));
    }
}

TEST(Hull, VerticesAnswerWhereBoxesDoNot) {
    // Octahedra that stand on a face: their boxes reach through the ground, they do not. Each mesh has its
    // own reach.
    Scene scene;
    const int ground = add_wall(scene, 2, 0.0);
    const glm::dvec3 diagonal = glm::normalize(glm::dvec3(1.0));
    const glm::dmat4 upright =
        glm::rotate(glm::dmat4(1.0), std::acos(diagonal.z), glm::cross(diagonal, glm::dvec3(0.0, 0.0, 1.0)));
    int small = 0;
    for (const float radius : {1.0F, 0.3F}) {
        Primitive p;
        for (int axis = 0; axis < 3; ++axis) {
            for (const float side : {-radius, radius}) {
                glm::vec3 position(0.0F);
                position[axis] = side;
                p.positions.push_back(position);
            }
        }
        for (const uint32_t x : {0U, 1U}) {
            for (const uint32_t y : {2U, 3U}) {
                for (const uint32_t z : {4U, 5U}) {
                    p.indices.insert(p.indices.end(), {x, y, z});
                }
            }
        }
        // From its middle to a face an octahedron has its radius over the root of 3.
        const double height = 1.01 * static_cast<double>(radius) / std::sqrt(3.0);
        small = place_mesh(scene, add_mesh(scene, p), moved({0.0, 0.0, height}) * upright);
    }
    EXPECT_TRUE(find(scene).node(ground));
    scene.nodes[static_cast<size_t>(small)].matrix = moved({0.0, 0.0, 0.1}) * upright;
    EXPECT_FALSE(find(scene).node(ground));
}

TEST(Hull, MovingObjectsChangeIt) {
    // One finder asked twice: what it remembers of meshes must not be what it remembers of places.
    Scene scene;
    const int ground = add_wall(scene, 2, 0.0);
    Node ball;
    ball.mesh = add_mesh(scene, triangle_soup(40, 2));
    ball.local.translation = {0.0, 0.0, 1.5};
    add_node(scene, ball);
    scene.frames = {1, 3, 1.0};
    Animation animation;
    animation.samplers.push_back({Interpolation::linear, 3, {0.0F, 2.0F}, {0, 0, 1.5F, 0, 0, -1.5F}});
    animation.channels.push_back({Property::node_translation, 1, 0});
    scene.animations.push_back(animation);
    Found found{surface_parts(scene, k_all_animations), {}};
    HullFinder finder(scene, found.parts);
    for (const double time : {0.0, 1.0, 2.0, 0.0, 1.0}) {
        found.on_hull = finder.on_hull(evaluate_pose(scene, time));
        EXPECT_EQ(found.node(ground), time != 1.0) << "half sunk at 1 s, seconds " << time;
    }
}

TEST(Hull, HiddenSurfacesAreNotOnItAndBlockNothing) {
    Scene scene;
    const int ground = add_wall(scene, 2, 0.0);
    const int sunk = place_mesh(scene, add_mesh(scene, triangle_soup(40, 2)), moved({0.0, 0.0, -0.2}));
    EXPECT_FALSE(find(scene).node(ground));
    scene.nodes[static_cast<size_t>(sunk)].visible = false;
    EXPECT_TRUE(find(scene).node(ground));
    scene.nodes[static_cast<size_t>(ground)].visible = false;
    EXPECT_FALSE(find(scene).node(ground)) << "what is not drawn is on no hull";
}

TEST(Hull, SkinnedAndMorphedObjectsCount) {
    // A square above the ground, morphed down through it.
    Scene scene;
    const int ground = add_wall(scene, 2, 0.0);
    Primitive p = triangle_soup(10, 2);
    for (glm::vec3& position : p.positions) {
        position.z = std::abs(position.z) + 0.1F;
    }
    MorphTarget down;
    down.positions.assign(p.positions.size(), glm::vec3(0.0F, 0.0F, -3.0F));
    p.targets = {down};
    const int node = place_mesh(scene, add_mesh(scene, p));
    scene.nodes[static_cast<size_t>(node)].weights = {0.0F};
    EXPECT_TRUE(find(scene).node(ground));
    scene.nodes[static_cast<size_t>(node)].weights = {0.3F};
    EXPECT_FALSE(find(scene).node(ground));
}

TEST(Hull, NoSegmentOfTheSceneCrossesIt) {
    // Rooms with boxes at random places, some through the walls: whatever is said to be on the hull lets
    // every segment between two vertices of the scene lie on one side of it.
    std::mt19937 random(7);
    std::uniform_real_distribution<double> in(-1.0, 1.0);
    int walls_on_hull = 0;
    int walls_off_hull = 0;
    for (int trial = 0; trial < 20; ++trial) {
        Scene scene;
        for (int axis = 0; axis < 3; ++axis) {
            for (const double at : {-2.0, 2.0}) {
                add_wall(scene, axis, at, 0.3 * trial);
            }
        }
        for (int i = 0; i < 3; ++i) {
            place_mesh(scene, add_mesh(scene, box(glm::vec3(0.4F))),
                       turned(0.3 * trial) * moved(1.6 * glm::dvec3(in(random), in(random), in(random))) *
                           scaled({1.0, 1.0, 1.0 + 0.8 * std::abs(in(random))}) * turned(in(random)));
        }
        const Found found = find(scene);
        const Pose pose = evaluate_pose(scene, 0.0);
        const double tolerance = 1.01e-3 * world_bounds(scene, pose).diagonal();
        for (size_t i = 0; i < found.on_hull.size(); ++i) {
            const SurfacePart& part = found.parts.parts[i];
            const PointSurface& surface = found.parts.surfaces[part.surface];
            const glm::dmat4& m = pose.world_from_node[static_cast<size_t>(surface.node)];
            if (!part.table->flat) {
                EXPECT_FALSE(found.on_hull[i]);
                continue;
            }
            const Primitive& p = scene.meshes[static_cast<size_t>(surface.mesh)].primitives[0];
            std::array<glm::dvec3, 3> c;
            for (int k = 0; k < 3; ++k) {
                c[static_cast<size_t>(k)] =
                    glm::dvec3(m * glm::dvec4(glm::dvec3(p.positions[part.table->triangles[0][k]]), 1.0));
            }
            const glm::dvec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
            double low = 0.0;
            double high = 0.0;
            for (const DrawInstance& draw : pose.draws) {
                for (const glm::vec3& position :
                     scene.meshes[static_cast<size_t>(draw.mesh)].primitives[0].positions) {
                    const double off = glm::dot(
                        normal,
                        glm::dvec3(draw.world_from_model * glm::dvec4(glm::dvec3(position), 1.0)) - c[0]);
                    low = std::min(low, off);
                    high = std::max(high, off);
                }
            }
            const bool one_sided = std::min(-low, high) <= tolerance;
            EXPECT_EQ(found.on_hull[i], one_sided) << "trial " << trial << ", part " << i;
            if (surface.node < 6) {
                ++(found.on_hull[i] ? walls_on_hull : walls_off_hull);
            }
        }
    }
    EXPECT_GT(walls_on_hull, 20) << "a case that tells";
    EXPECT_GT(walls_off_hull, 5);
}

}  // namespace
}  // namespace bounce::scene::test
