// SPDX-License-Identifier: Apache-2.0
//
// Virtual point lights carry the flux of the reflective shadow maps they are drawn from: both are read back.
#include <bit>
#include <cstring>

#include <glm/gtc/packing.hpp>

#include "ism_fixture.h"
#include "passes/rsm.h"
#include "passes/vpl_sampling.h"
#include "renderer/ism_layout.h"
#include "renderer/light_setup.h"

namespace bounce::test {
namespace {

struct Fluxes {
    std::vector<glm::dvec3> maps;  // one a light: what its map reflects diffusely
    glm::dvec3 lights{0.0};        // what the virtual point lights do
    std::vector<gpu::GpuVpl> vpls;
    [[nodiscard]] glm::dvec3 map() const {
        glm::dvec3 sum(0.0);
        for (const glm::dvec3& flux : maps) {
            sum += flux;
        }
        return sum;
    }
};

class VplEnergy : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    // A texel's solid angle from the light, or area across a sun's rays.
    static double measure(const gpu::GpuLight& light, int kind, int x, int y, int size) {
        const double side = 2.0 / size;
        if (kind == MAP_ORTHOGRAPHIC) {
            return side * side * static_cast<double>(light.tangent.w) *
                   static_cast<double>(light.bitangent.w);
        }
        const double tan_half = kind == MAP_CUBE ? 1.0 : static_cast<double>(light.axis.w);
        // Exactly: a corner of a rectangle at distance 1 sees atan(a b / sqrt(1 + a^2 + b^2)).
        const auto corner = [&](int i, int j) {
            const double a = (i * side - 1.0) * tan_half;
            const double b = (j * side - 1.0) * tan_half;
            return std::atan(a * b / std::sqrt(1.0 + a * a + b * b));
        };
        return corner(x + 1, y + 1) - corner(x, y + 1) - corner(x + 1, y) + corner(x, y);
    }

    static glm::dvec3 flux_of_map(const gl::Texture& map, const LightSetup& light) {
        const int size = map.desc().width;
        const size_t layers = light.faces.size();
        std::vector<glm::uvec4> texels(static_cast<size_t>(size * size) * layers);
        glGetTextureImage(map.id(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                          static_cast<GLsizei>(texels.size() * sizeof(glm::uvec4)), texels.data());
        glm::dvec3 sum(0.0);
        for (size_t i = 0; i < texels.size(); ++i) {
            const glm::uvec4& bits = texels[i];
            if (bits.x == 0U) {
                continue;
            }
            const glm::dvec3 color(glm::unpackHalf2x16(bits.z), glm::unpackHalf2x16(bits.w).x);
            const double metallic = (bits.w >> 23U & 15U) / 15.0;
            const int x = static_cast<int>(i) % size;
            const int y = static_cast<int>(i) / size % size;
            sum += color * (1.0 - metallic) * glm::dvec3(light.gpu.intensity) *
                   measure(light.gpu, light.map_kind, x, y, size);
        }
        return sum;
    }

    static Fluxes draw_vpls(const scene::Scene& scene, const Settings& settings, bool glossy = false) {
        const scene::Pose pose = scene::evaluate_pose(scene, 0.0);
        gpu::GpuScene gpu_scene(scene);
        gpu_scene.set_pose(pose);
        gl::ProgramCache programs;
        gpu::UniformArena uniforms;
        const passes::PassContext context{.programs = programs,
                                          .scene = gpu_scene,
                                          .uniforms = uniforms,
                                          .frame = uniforms.add(gpu::FrameUniforms{}),
                                          .width = 1,
                                          .height = 1};
        TransientPool pool;
        FrameGraph graph(pool);
        std::vector<LightSetup> setups;
        std::vector<passes::VplSource> sources;
        for (const scene::LightInstance& instance : pose.light_instances) {
            const LightSetup setup =
                set_up_light(instance, pose.lights[static_cast<size_t>(instance.light)], gpu_scene.bounds(),
                             gpu_scene.space(), settings.used_rsm_size(), 64);
            passes::LightPass pass;
            pass.name = setup.name;
            pass.map_kind = setup.map_kind;
            pass.profile = setup.profile;
            pass.uniforms = uniforms.add(setup.gpu);
            for (const LightFace& face : setup.faces) {
                pass.faces.push_back({uniforms.add(gpu::ViewUniforms{face.clip_from_render, {}}),
                                      face.clip_from_render, face.mirrored});
            }
            pass.rsm_size = static_cast<int>(setup.gpu.map.x);
            sources.push_back({pass, passes::add_rsm(graph, context, pass)});
            setups.push_back(setup);
        }
        const IsmLayout layout = ism_layout(settings, 1, 0);
        passes::VplSet set;
        set.maps = layout.vpls;
        set.map_size = layout.map_size;
        set.columns = layout.columns;
        set.rows = layout.rows();
        set.interleave = layout.interleave;
        set.subset = layout.subset;
        set.cell_columns = layout.cell_columns;
        const passes::DrawnVpls drawn =
            passes::add_vpls_from_rsms(graph, context, sources, set, {.glossy = glossy, .view = {}});
        Fluxes out;
        graph.add_pass("read back", [&](PassBuilder& builder) {
            builder.read(drawn.set.vpls);
            for (const passes::VplSource& source : sources) {
                builder.read(source.rsm);
            }
            builder.side_effect();
            return [&](const PassResources& resources) {
                const auto all =
                    resources.buffer(drawn.set.vpls).read<gpu::GpuVpl>(static_cast<size_t>(layout.vpls));
                for (const gpu::GpuVpl& vpl : all) {
                    out.vpls.push_back(vpl);
                    out.lights += pi * glm::dvec3(glm::vec3(vpl.intensity));
                }
                for (size_t i = 0; i < sources.size(); ++i) {
                    out.maps.push_back(flux_of_map(resources.texture(sources[i].rsm), setups[i]));
                }
            };
        });
        uniforms.upload();
        gl::PassTimer timer(gl::TimingMode::off);
        graph.execute(timer);
        return out;
    }
    static double luminance(const glm::dvec3& c) { return glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722)); }

    static Settings with(int vpls, int interleave) {
        Settings settings = bounced(32);
        settings.vpls = vpls;
        settings.interleave = interleave;
        return settings;
    }
    struct Case {
        const char* name;
        scene::LightType type;
        glm::dmat4 matrix;
    };
    static std::vector<Case> cases() {
        return {{"spot", scene::LightType::spot, rotated(25.0, {0.0, 1.0, 0.0}, {0.5, 0.2, 3.0})},
                {"sun", scene::LightType::sun, rotated(35.0, {0.0, 1.0, 0.0}, {0.0, 0.0, 3.0})},
                {"point", scene::LightType::point, moved({0.3, 0.4, 1.5})},
                {"area", scene::LightType::area, moved({0.0, 0.4, 2.5})}};
    }
    static scene::Scene white_corner() {
        scene::Scene scene = corner_scene();
        for (scene::Material& material : scene.materials) {
            material.base_color = glm::vec4(0.7F, 0.7F, 0.7F, 1.0F);
        }
        return scene;
    }
};

TEST_F(VplEnergy, OfEachKindOfLightIsThatOfItsMap) {
    for (const Case& test : cases()) {
        scene::Scene scene = white_corner();
        add_light(scene, light_of(test.type), test.matrix);
        for (const int n : {1, 4, 8}) {
            for (const int vpls : {64, 100, 256}) {
                const Fluxes f = draw_vpls(scene, with(vpls, n));
                ASSERT_GT(luminance(f.map()), 0.0);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(f.lights[c] / f.map()[c], 1.0, 1e-3)
                        << test.name << ", " << vpls << ", n " << n;
                }
                // All are worth the same, so that every subset of the gather is.
                for (const gpu::GpuVpl& vpl : f.vpls) {
                    EXPECT_NEAR(pi * luminance(glm::dvec3(glm::vec3(vpl.intensity))) *
                                    static_cast<double>(f.vpls.size()) / luminance(f.map()),
                                1.0, 2e-3)
                        << test.name;
                }
            }
        }
    }
}

TEST_F(VplEnergy, OfColoursIsExactInLuminanceAndNearInEachChannel) {
    for (const Case& test : cases()) {
        scene::Scene scene = corner_scene();
        add_light(scene, light_of(test.type), test.matrix);
        const Fluxes f = draw_vpls(scene, with(256, 4));
        EXPECT_NEAR(luminance(f.lights) / luminance(f.map()), 1.0, 1e-3) << test.name;
        for (int c = 0; c < 3; ++c) {
            // Where a cell lies across an edge its light has the colour of one side.
            EXPECT_NEAR(f.lights[c] / f.map()[c], 1.0, 0.025) << test.name << ", channel " << c;
        }
    }
}

TEST_F(VplEnergy, OfTexturesAndMetals) {
    scene::Scene scene = corner_scene();
    scene.materials[0].metallic = 0.4F;
    scene.textures.resize(1);
    scene.textures[0].image = 0;
    scene::Image image;
    image.width = image.height = 16;
    for (int i = 0; i < 256; ++i) {
        const auto value = static_cast<uint8_t>((i * 37 + i / 16 * 11) % 256);
        image.rgba8.insert(image.rgba8.end(), {value, static_cast<uint8_t>(255 - value), 128, 255});
    }
    scene.images.push_back(image);
    scene.materials[0].base_color_texture.texture = 0;
    scene.meshes[0].primitives[0].uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (const Case& test : cases()) {
        scene::Scene lit = scene;
        add_light(lit, light_of(test.type), test.matrix);
        const Fluxes f = draw_vpls(lit, with(256, 4));
        EXPECT_NEAR(luminance(f.lights) / luminance(f.map()), 1.0, 1e-3) << test.name;
        for (int c = 0; c < 3; ++c) {
            // Where a cell lies across an edge its light has the colour of one side.
            EXPECT_NEAR(f.lights[c] / f.map()[c], 1.0, 0.025) << test.name << ", channel " << c;
        }
    }
}

TEST_F(VplEnergy, OfSeveralLightsTogether) {
    scene::Scene scene = white_corner();
    for (const Case& test : cases()) {
        add_light(scene, light_of(test.type), test.matrix);
    }
    for (const int vpls : {64, 256, 1024}) {
        const Fluxes f = draw_vpls(scene, with(vpls, 4));
        EXPECT_NEAR(luminance(f.lights) / luminance(f.map()), 1.0, 1e-3) << vpls;
    }
}

TEST_F(VplEnergy, EachOfSeveralLightsKeepsItsOwn) {
    // A red, a green and a blue light of unlike strengths on white: each channel is one light. Virtual point
    // lights are worth the same, so a light has its own up to one of them.
    for (const glm::dvec3& power :
         {glm::dvec3(100, 100, 100), glm::dvec3(100, 30, 7), glm::dvec3(1, 50, 3), glm::dvec3(1, 1, 300)}) {
        scene::Scene scene = white_corner();
        for (int c = 0; c < 3; ++c) {
            scene::Light light = light_of(scene::LightType::spot);
            light.color = glm::vec3(0.0F);
            light.color[c] = 1.0F;
            light.power_w = static_cast<float>(power[c]);
            add_light(scene, light, rotated(25.0 + 5.0 * c, {0.0, 1.0, 0.0}, {0.5 - 0.3 * c, 0.2, 3.0}));
        }
        for (const int vpls : {48, 256, 1000}) {
            const Fluxes f = draw_vpls(scene, with(vpls, 4));
            EXPECT_NEAR(luminance(f.lights) / luminance(f.map()), 1.0, 1e-3);
            for (int c = 0; c < 3; ++c) {
                glm::dvec3 channel(0.0);
                channel[c] = f.lights[c] - f.map()[c];
                EXPECT_LT(std::abs(luminance(channel)) / luminance(f.map()),
                          1.0 / static_cast<double>(f.vpls.size()))
                    << power.x << ' ' << power.y << ' ' << power.z << ", channel " << c << ", " << vpls;
            }
        }
    }
}

TEST_F(VplEnergy, OfManyMoreLightsThanAreDrawn) {
    scene::Scene scene = white_corner();
    for (int i = 0; i < 40; ++i) {
        scene::Light light = light_of(scene::LightType::spot);
        light.power_w = 1.0F + static_cast<float>(i % 7);
        add_light(scene, light, rotated(20.0 + i, {0.0, 1.0, 0.0}, {0.5, 0.2 - 0.01 * i, 3.0}));
    }
    Settings settings = with(16, 1);
    settings.rsm_size = 32;
    const Fluxes f = draw_vpls(scene, settings);
    EXPECT_NEAR(luminance(f.lights) / luminance(f.map()), 1.0, 2e-3) << "those drawn stand for the others";
}

TEST_F(VplEnergy, WithoutFluxAllAreDark) {
    scene::Scene scene = corner_scene();
    scene::Light spot = light_of(scene::LightType::spot);
    add_light(scene, spot, rotated(180.0, {1.0, 0.0, 0.0}, {0.0, 0.0, 10.0}));  // looks away
    const Fluxes f = draw_vpls(scene, with(64, 4));
    EXPECT_EQ(f.map(), glm::dvec3(0.0));
    for (const gpu::GpuVpl& vpl : f.vpls) {
        EXPECT_EQ(glm::vec3(vpl.intensity), glm::vec3(0.0F));
    }
}

TEST_F(VplEnergy, LightsStandOnTheLitSurfacesAndFaceTheRoom) {
    scene::Scene scene = corner_scene();
    add_light(scene, light_of(scene::LightType::point), moved({0.3, 0.4, 1.5}));
    const scene::Pose pose = scene::evaluate_pose(scene, 0.0);
    const gpu::RenderSpace space = gpu::RenderSpace::around(scene::world_bounds(scene, pose));
    for (const gpu::GpuVpl& vpl : draw_vpls(scene, with(256, 4)).vpls) {
        const glm::dvec3 at = glm::dvec3(glm::vec3(vpl.position)) / space.scale + space.origin;
        const bool on_floor = std::abs(at.z) < 2e-3 && vpl.normal.z > 0.999F;
        const bool on_wall = std::abs(at.x + 2.0) < 2e-3 && vpl.normal.x > 0.999F;
        EXPECT_TRUE(on_floor || on_wall) << at.x << ' ' << at.y << ' ' << at.z;
        EXPECT_GT(vpl.position.w, 0.0F) << "stands for some area";
    }
}

}  // namespace
}  // namespace bounce::test
