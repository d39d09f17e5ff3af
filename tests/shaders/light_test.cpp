// SPDX-License-Identifier: Apache-2.0
//
// A light's maps: the shaders' own projection, and its agreement with the matrices that draw the maps.
#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/light_setup.h"
#include "shader_harness.h"

namespace bounce::test {
namespace {

class LightGlsl : public ShaderTest {
  protected:
    static gl::Defines defines(const LightSetup& setup) {
        return {{"MAP_KIND", std::to_string(setup.map_kind)}, {"PROFILE", std::to_string(setup.profile)}};
    }
    static gl::Buffer upload(const LightSetup& setup) {
        return gl::Buffer::of("light", std::span<const gpu::GpuLight>(&setup.gpu, 1));
    }
    // A light somewhere off centre, turned, in a scene of ten metres.
    static LightSetup place(scene::LightType type, double cone = 1.2) {
        scene::Light light;
        light.type = type;
        light.power_w = 10.0F;
        light.irradiance_w_m2 = 1.0F;
        light.cone_angle_rad = static_cast<float>(cone);
        scene::Bounds bounds;
        bounds.grow(glm::dvec3(-5.0, -1.0, -5.0));
        bounds.grow(glm::dvec3(5.0, 4.0, 5.0));
        const glm::dmat4 matrix = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, 2.0, -0.5)),
                                              0.9, glm::normalize(glm::dvec3(0.3, -1.0, 0.6)));
        return set_up_light({0, 0, matrix}, light, bounds, gpu::RenderSpace::around(bounds), 64, 64);
    }
    // Points all over render space, which is about one unit large.
    static std::vector<glm::vec4> points() {
        std::vector<glm::vec4> out;
        int i = 0;
        for (const glm::dvec3& d : directions(3000)) {
            const double distance = 0.01 + 0.9 * ((i++ * 7919 % 1000) / 1000.0);
            out.emplace_back(glm::vec3(d * distance), 1.0F);
        }
        return out;
    }
    // Every place that the shader finds for a point is where the matrix of that layer draws it.
    void expect_agreement(const LightSetup& setup) {
        const gl::Buffer block = upload(setup);
        block.bind_uniform(UBO_LIGHT);
        const std::vector<glm::vec4> in = points();
        const std::vector<glm::vec4> out = run("light_map.comp", 1, 2, in, defines(setup));
        int inside = 0;
        for (size_t i = 0; i < in.size(); ++i) {
            EXPECT_LT(glm::length(glm::vec3(out[2 * i + 1] - in[i])), 1e-6F);
            const glm::vec4 found = out[2 * i];
            const auto layer = static_cast<size_t>(found.x);
            ASSERT_LT(layer, setup.faces.size());
            const glm::vec4 clip = setup.faces[layer].clip_from_render * glm::vec4(glm::vec3(in[i]), 1.0F);
            if (clip.w < 0.01F || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) {
                EXPECT_NE(setup.map_kind, MAP_CUBE) << "a cube's face holds every point that falls to it";
                continue;
            }
            ++inside;
            ASSERT_NEAR(found.y, clip.x / clip.w, 2e-5F);
            ASSERT_NEAR(found.z, clip.y / clip.w, 2e-5F);
            if (setup.map_kind == MAP_ORTHOGRAPHIC) {
                ASSERT_NEAR(1.0F - found.w / setup.gpu.map.z, clip.z, 1e-5F);
            } else {
                ASSERT_NEAR(found.w, clip.w, 1e-6F);
                ASSERT_NEAR(setup.gpu.map.z / found.w / (clip.z / clip.w), 1.0F, 1e-5F)
                    << "depth is near over distance";
            }
        }
        EXPECT_GT(inside, 300);
    }
};

TEST_F(LightGlsl, CubeFaceAndDirectionAreInverse) {
    std::vector<glm::vec4> in;
    for (const glm::dvec3& d : directions(6000)) {
        in.emplace_back(glm::vec3(d * 3.7), 0.0F);
    }
    const std::vector<glm::vec4> out =
        run("cube.comp", 1, 2, in, {{"MAP_KIND", std::to_string(MAP_CUBE)}, {"PROFILE", "0"}});
    std::vector<int> hits(6);
    for (size_t i = 0; i < in.size(); ++i) {
        const auto face = static_cast<size_t>(out[2 * i].x);
        ASSERT_LT(face, 6U);
        ++hits[face];
        ASSERT_LE(std::abs(out[2 * i].y), 1.0F);
        ASSERT_LE(std::abs(out[2 * i].z), 1.0F);
        // depth times the direction of the place is the vector itself.
        const glm::vec3 back = out[2 * i].w * glm::vec3(out[2 * i + 1]);
        ASSERT_LT(glm::length(back - glm::vec3(in[i])), 2e-6F);
    }
    EXPECT_GT(*std::min_element(hits.begin(), hits.end()), 900) << "a sixth of the sphere each";
}

TEST_F(LightGlsl, CubeFacesAreDrawnWhereTheyAreLookedUp) {
    expect_agreement(place(scene::LightType::point));
}

TEST_F(LightGlsl, AreaAndWideSpotUseTheSameCube) {
    expect_agreement(place(scene::LightType::area));
    expect_agreement(place(scene::LightType::spot, 3.0));
}

TEST_F(LightGlsl, SpotMapIsDrawnWhereItIsLookedUp) {
    expect_agreement(place(scene::LightType::spot, 2.0));
}

TEST_F(LightGlsl, SunMapIsDrawnWhereItIsLookedUp) {
    expect_agreement(place(scene::LightType::sun));
}

}  // namespace
}  // namespace bounce::test
