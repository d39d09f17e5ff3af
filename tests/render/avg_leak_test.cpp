// SPDX-License-Identifier: Apache-2.0
//
// Closed things that are hard on a grid: what light leaves them, whatever their walls, however they are
// turned.
#include "avg_fixture.h"

namespace bounce::test {
namespace {

class AvgLeaks : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    static scene::Scene closed(const std::vector<glm::vec3>& corners, const glm::dmat4& turned,
                               const glm::dvec3& light_at) {
        scene::Scene scene;
        scene.from_blender = true;
        add_mesh_node(scene, add_triangles(scene, corners, add_diffuse(scene, glm::vec3(0.9F))), turned);
        add_light(scene, light_of(scene::LightType::point), turned * moved(light_at));
        return scene;
    }
    // Two pyramids base to base: a lens of square outline, half as wide as 1 and as thick as `half`.
    static std::vector<glm::vec3> lens(float half) {
        std::vector<glm::vec3> out;
        const std::array<glm::vec3, 4> rim = {
            glm::vec3(1.0F, 1.0F, 0.0F), {-1.0F, 1.0F, 0.0F}, {-1.0F, -1.0F, 0.0F}, {1.0F, -1.0F, 0.0F}};
        for (size_t i = 0; i < 4; ++i) {
            const glm::vec3& a = rim[i];
            const glm::vec3& b = rim[(i + 1) % 4];
            out.insert(out.end(), {a, b, {0.0F, 0.0F, half}, b, a, {0.0F, 0.0F, -half}});
        }
        return out;
    }
    // Of 4,096 rays of four bounces. What leaks is a light beside a voxel's edge, where the next voxel's slab
    // is taken for its own: it depends on how slabs that are not flat meet. With one slab for both sides of a
    // wall it is thousands.
    static constexpr int k_few_of_flat_sides = 2;
    static constexpr int k_few_of_tilted_sides = 20;
    // Lights that rays made, of all bounces: how many met nothing, and how many stand beyond `inside` of the
    // thing's own coordinates.
    template <typename Inside>
    static std::array<int, 2> lost_and_outside(const Traced& result, const glm::dmat4& turned,
                                               const Inside& inside) {
        std::array<int, 2> out{};
        for (const auto& bounce : result.bounces) {
            for (const gpu::GpuVpl& vpl : bounce) {
                const glm::dvec3 at(glm::inverse(turned) * glm::dvec4(result.place(vpl), 1.0));
                out[0] += is_dark(vpl) ? 1 : 0;
                out[1] += !is_dark(vpl) && !inside(at) ? 1 : 0;
            }
        }
        return out;
    }
    static glm::dmat4 any_turn(std::mt19937& random) {
        std::uniform_real_distribution<double> part(-1.0, 1.0);
        return rotated(180.0 * part(random), {part(random), part(random), 1.1 + part(random)},
                       {0.3 * part(random), 0.2, -0.1});
    }
};

TEST_F(AvgLeaks, LightStaysInABoxHoweverFlat) {
    // From wide to a twentieth of a voxel (2/31 or less): between its sides is a voxel's only surface.
    std::mt19937 random(19);
    for (const float half : {0.5F, 0.1F, 0.03F, 0.01F, 0.0016F}) {
        for (int turn = 0; turn < 6; ++turn) {
            const glm::dmat4 turned = turn == 0 ? glm::dmat4(1.0) : any_turn(random);
            const Traced result =
                trace(closed(box_triangles({1.0F, 1.0F, half}, 3), turned, {0.31, -0.23, 0.2 * half}),
                      traced(32, 4, 1024));
            const auto [lost, outside] = lost_and_outside(result, turned, [&](const glm::dvec3& at) {
                return glm::all(glm::lessThan(glm::abs(at), glm::dvec3(1.0, 1.0, half) + 1e-6));
            });
            EXPECT_LE(lost + outside, k_few_of_flat_sides) << "half thickness " << half << ", turn " << turn;
        }
    }
}

TEST_F(AvgLeaks, LightStaysInALens) {
    // Both sides' normals point along the same axis, so that along the rim they are one surface of a voxel.
    std::mt19937 random(23);
    for (const float half : {0.5F, 0.2F, 0.05F, 0.01F}) {
        for (int turn = 0; turn < 6; ++turn) {
            const glm::dmat4 turned = turn == 0 ? glm::dmat4(1.0) : any_turn(random);
            const Traced result =
                trace(closed(lens(half), turned, {0.6, 0.1, 0.1 * half}), traced(32, 4, 1024));
            const auto [lost, outside] = lost_and_outside(result, turned, [&](const glm::dvec3& at) {
                const double rim = std::max(std::abs(at.x), std::abs(at.y));
                return rim <= 1.0 + 1e-6 && std::abs(at.z) <= half * (1.0 - rim) + 1e-6;
            });
            EXPECT_LE(lost + outside, k_few_of_tilted_sides)
                << "half thickness " << half << ", turn " << turn;
        }
    }
}

TEST_F(AvgLeaks, NoLightPassesAWallOfAnyThickness) {
    // A box in a box, with the light on either side; a voxel is 4/63 or somewhat more.
    std::mt19937 random(29);
    for (const float wall : {0.0F, 0.001F, 0.006F, 0.03F, 0.07F, 0.2F}) {
        for (int turn = 0; turn < 3; ++turn) {
            for (const bool inside : {true, false}) {
                const glm::dmat4 turned = turn == 0 ? glm::dmat4(1.0) : any_turn(random);
                scene::Scene scene = closed(box_triangles(glm::vec3(2.0F), 1), turned,
                                            inside ? glm::dvec3(0.3, -0.4, 0.6) : glm::dvec3(1.5, 0.3, -1.2));
                for (const float half : {1.0F, 1.0F + wall}) {
                    add_mesh_node(scene, add_triangles(scene, box_triangles(glm::vec3(half), 2), 0), turned);
                }
                const Traced result = trace(scene, traced(64, 4, 1024));
                const double middle = 1.0 + 0.5 * static_cast<double>(wall);
                const auto [lost, wrong] = lost_and_outside(result, turned, [&](const glm::dvec3& at) {
                    const glm::dvec3 a = glm::abs(at);
                    const double out = std::max({a.x, a.y, a.z});
                    // To a thousandth of a voxel, where the wall has no thickness.
                    return inside ? out <= middle + 6e-5 : out >= middle - 6e-5;
                });
                EXPECT_EQ(lost, 0) << "wall " << wall << ", turn " << turn << ", inside " << inside;
                EXPECT_EQ(wrong, 0) << "wall " << wall << ", turn " << turn << ", inside " << inside;
            }
        }
    }
}

}  // namespace
}  // namespace bounce::test
