// SPDX-License-Identifier: Apache-2.0
//
// What the G-buffer and a reflective shadow map keep of a surface.
#include <algorithm>
#include <array>
#include <bit>

#include <glm/gtc/matrix_transform.hpp>

#include "gl/texture.h"
#include "renderer/light_setup.h"
#include "shader_harness.h"

namespace bounce::test {
namespace {

class PackingGlsl : public ShaderTest {};

TEST_F(PackingGlsl, SpecularAndDiffuseModelShareSixteenBits) {
    std::vector<glm::vec4> in;
    for (int i = 0; i <= 200; ++i) {
        for (const float disney : {0.0F, 1.0F}) {
            in.emplace_back(static_cast<float>(i) * 0.01F, disney, 0.0F, 0.0F);
        }
    }
    in.emplace_back(5.0F, 1.0F, 0.0F, 0.0F);  // beyond what is kept
    in.emplace_back(-1.0F, 0.0F, 0.0F, 0.0F);
    const std::vector<glm::vec4> out = run("gbuffer_specular.comp", 1, 1, in);
    for (size_t i = 0; i < in.size(); ++i) {
        // 15 bits over 0 to 2.
        EXPECT_NEAR(out[i].x, std::clamp(in[i].x, 0.0F, 2.0F), 1.0F / 32767.0F);
        EXPECT_EQ(out[i].y, in[i].y) << "the diffuse model, at specular " << in[i].x;
        EXPECT_GE(out[i].z, 0.0F);
        EXPECT_LE(out[i].z, 1.0F);
    }
}

// Packs a texel for the point that lies on its own ray at `distance_along`, reads it back as the gather does
// and expects the same point.
class RsmTexel : public ShaderTest {
  protected:
    static constexpr int size = 8;

    void expect_round_trip(const scene::Light& light) {
        scene::Bounds bounds;
        bounds.grow(glm::dvec3(-2.0));
        bounds.grow(glm::dvec3(2.0));
        const glm::dmat4 matrix = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0.2, 0.5, -0.1)),
                                              0.7, glm::normalize(glm::dvec3(1, 2, 2)));
        LightSetup setup =
            set_up_light({0, 0, matrix}, light, bounds, gpu::RenderSpace::around(bounds), size, size);
        setup.gpu.map.x = static_cast<float>(size);
        const gl::Defines defines = {{"MAP_KIND", std::to_string(setup.map_kind)},
                                     {"PROFILE", std::to_string(setup.profile)}};
        const gl::Buffer block = gl::Buffer::of("light", std::span<const gpu::GpuLight>(&setup.gpu, 1));
        block.bind_uniform(UBO_LIGHT);

        const int layers = static_cast<int>(setup.faces.size());
        const std::vector<glm::dvec3> normals = directions(size * size * layers);
        std::vector<glm::vec4> pack;
        std::vector<glm::dvec3> points;
        std::vector<glm::vec4> places;
        size_t n = 0;
        for (int layer = 0; layer < layers; ++layer) {
            for (int y = 0; y < size; ++y) {
                for (int x = 0; x < size; ++x, ++n) {
                    const glm::dvec2 st((x + 0.5) * 2.0 / size - 1.0, (y + 0.5) * 2.0 / size - 1.0);
                    // The point of the texel's middle at a depth of its own, by the matrix that draws the
                    // map.
                    const double depth = 0.1 + 0.8 * static_cast<double>(n % 37) / 37.0;
                    const glm::dmat4 render_from_clip =
                        glm::inverse(glm::dmat4(setup.faces[static_cast<size_t>(layer)].clip_from_render));
                    const double clip_depth = setup.map_kind == MAP_ORTHOGRAPHIC
                                                  ? 1.0 - depth / static_cast<double>(setup.gpu.map.z)
                                                  : static_cast<double>(setup.gpu.map.z) / depth;
                    const glm::dvec4 p = render_from_clip * glm::dvec4(st, clip_depth, 1.0);
                    points.emplace_back(glm::dvec3(p) / p.w);
                    pack.emplace_back(glm::dvec4(depth, static_cast<double>(n % 16) / 15.0, 0.5, 0.3));
                    pack.emplace_back(glm::vec3(normals[n]), static_cast<float>(n % 2));
                    pack.emplace_back(1.6F, 2e-3F, 0.5F, 0.5F);  // half of it by the light's profile
                    // Not the middle: a sample anywhere in the texel reads the texel's own ray.
                    places.emplace_back(glm::dvec4(st + glm::dvec2(0.7 / size, -0.7 / size), layer, 0.0));
                }
            }
        }
        gl::Defines packing = defines;
        packing["PACK"] = "1";
        const std::vector<glm::vec4> bits = run("rsm_texel.comp", 3, 1, pack, packing);
        const gl::Texture map("rsm",
                              {.format = GL_RGBA32UI, .width = size, .height = size, .layers = layers});
        glTextureSubImage3D(map.id(), 0, 0, 0, 0, size, size, layers, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                            bits.data());
        map.bind(TEX_RSM);
        const std::vector<glm::vec4> out = run("rsm_texel.comp", 1, 5, places, defines);
        const glm::dvec3 light_position(glm::vec3(setup.gpu.position));
        for (size_t i = 0; i < points.size(); ++i) {
            EXPECT_EQ(out[5 * i].w, 1.0F) << "something was hit";
            ASSERT_LT(glm::length(glm::dvec3(glm::vec3(out[5 * i])) - points[i]), 2e-5) << i;
            ASSERT_LT(angle_between(glm::dvec3(glm::vec3(out[5 * i + 1])), normals[i]), 6.6e-5);
            const glm::vec4 flux = out[5 * i + 2];
            ASSERT_NEAR(flux.x / 0.8F, 1.0F, 1e-3F) << "a half has 11 bits";
            ASSERT_NEAR(flux.y / 1e-3F, 1.0F, 1e-3F);
            ASSERT_NEAR(flux.z / 0.25F, 1.0F, 1e-3F);
            ASSERT_NEAR(flux.w, 0.3F, 0.5F / 127.0F) << "roughness has 7 bits";
            const glm::vec4 lobes = out[5 * i + 4];
            ASSERT_NEAR(lobes.x, static_cast<float>(i % 16) / 15.0F, 1e-6F) << "metallic has 4 bits";
            ASSERT_NEAR(lobes.y, 0.5F, 1e-6F) << "specular has 4 bits, up to 15/8";
            ASSERT_EQ(lobes.z, i % 2 == 1 ? 1.0F : 0.0F) << "the diffuse model";
            if (setup.map_kind == MAP_ORTHOGRAPHIC) {
                ASSERT_LT(glm::length(glm::vec3(out[5 * i + 3]) - glm::vec3(setup.gpu.axis)), 1e-6F);
            } else {
                const glm::dvec3 way = points[i] - light_position;
                ASSERT_LT(angle_between(glm::dvec3(glm::vec3(out[5 * i + 3])), way), 1e-4);
                ASSERT_NEAR(static_cast<double>(out[5 * i + 3].w) / glm::dot(way, way), 1.0, 1e-3);
            }
        }
    }
};

scene::Light light_of(scene::LightType type) {
    scene::Light light;
    light.type = type;
    light.power_w = 1.0F;
    light.irradiance_w_m2 = 1.0F;
    light.cone_angle_rad = 1.5F;
    return light;
}

TEST_F(RsmTexel, OfASpot) {
    expect_round_trip(light_of(scene::LightType::spot));
}

TEST_F(RsmTexel, OfASun) {
    expect_round_trip(light_of(scene::LightType::sun));
}

TEST_F(RsmTexel, OfAPointLightsCube) {
    expect_round_trip(light_of(scene::LightType::point));
}

TEST_F(RsmTexel, AnEmptyTexelIsNoLight) {
    const scene::Light light = light_of(scene::LightType::spot);
    const LightSetup setup = set_up_light({0, 0, glm::dmat4(1.0)}, light, {}, {}, size, size);
    const gl::Buffer block = gl::Buffer::of("light", std::span<const gpu::GpuLight>(&setup.gpu, 1));
    block.bind_uniform(UBO_LIGHT);
    const gl::Texture map("rsm", {.format = GL_RGBA32UI, .width = size, .height = size, .layers = 1});
    constexpr std::array<GLuint, 4> nothing{};
    glClearTexImage(map.id(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, nothing.data());
    map.bind(TEX_RSM);
    const std::vector<glm::vec4> out = run("rsm_texel.comp", 1, 5, {glm::vec4(0.1F, 0.2F, 0.0F, 0.0F)},
                                           {{"MAP_KIND", std::to_string(setup.map_kind)}, {"PROFILE", "1"}});
    EXPECT_EQ(out[0].w, 0.0F);
}

TEST_F(RsmTexel, DisneyWithoutRoughnessIsStillDisney) {
    // The model has a bit of its own: no roughness turns it off.
    const std::vector<glm::vec4> bits =
        run("rsm_texel.comp", 3, 1,
            {glm::vec4(1.0F, 0.0F, 0.0F, 0.0F), glm::vec4(0.0F, 0.0F, 1.0F, 1.0F), glm::vec4(1.0F)},
            {{"PACK", "1"}, {"MAP_KIND", "0"}, {"PROFILE", "0"}});
    EXPECT_NE(std::bit_cast<uint32_t>(bits[0].w) >> 31, 0U);
}

}  // namespace
}  // namespace bounce::test
