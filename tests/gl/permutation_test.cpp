// SPDX-License-Identifier: Apache-2.0
//
// Every permutation of every shader that a pass may ask for compiles and links, whatever scene comes.
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "core/error.h"
#include "gl/program.h"
#include "gl_context.h"
#include "gpu/shared_types.h"
#include "passes/pass_context.h"

namespace bounce::gl {
namespace {

// All subsets of these switches, each over `base`.
std::vector<Defines> subsets(const std::vector<std::string>& switches, const Defines& base = {}) {
    std::vector<Defines> all;
    for (unsigned bits = 0; bits < (1U << switches.size()); ++bits) {
        Defines defines = base;
        for (size_t i = 0; i < switches.size(); ++i) {
            if ((bits >> i & 1U) != 0) {
                defines[switches[i]] = "1";
            }
        }
        all.push_back(std::move(defines));
    }
    return all;
}

Defines with(Defines defines, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        defines[name] = "1";
    }
    return defines;
}

// The pairs of map and profile that renderer/light_setup.cpp makes.
std::vector<Defines> light_kinds() {
    std::vector<Defines> kinds;
    const auto add = [&](int map_kind, int profile) {
        passes::LightPass light;
        light.map_kind = map_kind;
        light.profile = profile;
        kinds.push_back(passes::light_defines(light));
    };
    add(MAP_ORTHOGRAPHIC, PROFILE_UNIFORM);
    for (const int map_kind : {MAP_PERSPECTIVE, MAP_CUBE}) {
        for (const int profile : {PROFILE_SPOT_CYCLES_3, PROFILE_SPOT_CYCLES_4, PROFILE_SPOT_KHRONOS}) {
            add(map_kind, profile);
        }
    }
    add(MAP_CUBE, PROFILE_UNIFORM);
    add(MAP_CUBE, PROFILE_AREA);
    return kinds;
}

std::string describe(const Defines& defines) {
    std::string text;
    for (const auto& [name, value] : defines) {
        text += name + '=' + value + ' ';
    }
    return text;
}

class Permutations : public test::GlTest {
  protected:
    static void compute(const std::string& name, const Defines& defines) {
        EXPECT_NO_THROW(Program(name, {{GL_COMPUTE_SHADER, "passes/" + name}}, defines))
            << name << ' ' << describe(defines);
    }
    static void raster(const std::string& fragment, const Defines& defines) {
        EXPECT_NO_THROW(
            Program(fragment,
                    {{GL_VERTEX_SHADER, "passes/geometry.vert"}, {GL_FRAGMENT_SHADER, "passes/" + fragment}},
                    defines))
            << fragment << ' ' << describe(defines);
    }
    // What a batch's material may have, as batch_defines() in passes/pass_context.cpp names it.
    static std::vector<std::string> material_switches() {
        return {"ALPHA_TEST", "BASE_COLOR_TEXTURE", "VERTEX_COLOR", "METALLIC_ROUGHNESS_TEXTURE",
                "NORMAL_TEXTURE"};
    }
};

TEST_F(Permutations, ABrokenPermutationWouldBeSeen) {
    EXPECT_THROW(Program("direct_light.comp", {{GL_COMPUTE_SHADER, "passes/direct_light.comp"}},
                         {{"MAP_KIND", "no_such_kind("}, {"PROFILE", "0"}}),
                 Error);
}

TEST_F(Permutations, Composite) {
    for (const Defines& defines : subsets({"DIRECT", "INDIRECT", "WORLD", "EMISSION"})) {
        compute("composite.comp", defines);
    }
}

TEST_F(Permutations, Deform) {
    for (const Defines& defines : subsets({"TANGENTS"})) {
        compute("deform.comp", defines);
    }
}

TEST_F(Permutations, DirectLight) {
    for (const Defines& light : light_kinds()) {
        for (const Defines& defines : subsets({"FIRST_LIGHT", "DISNEY", "SPECULAR", "SHADOW"}, light)) {
            compute("direct_light.comp", defines);
        }
    }
}

TEST_F(Permutations, RsmGather) {
    const std::vector<std::vector<std::string>> modes = {{}, {"FULL_SUM"}, {"LOW_RESOLUTION"}, {"LIST"}};
    for (const Defines& light : light_kinds()) {
        for (const std::vector<std::string>& mode : modes) {
            for (const Defines& defines : subsets({"FIRST_LIGHT", "DISNEY"}, with(light, mode))) {
                compute("rsm_gather.comp", defines);
            }
        }
    }
}

TEST_F(Permutations, InterpolationAndViews) {
    compute("rsm_interpolate.comp", {});
    compute("interpolation_view.comp", {});
    for (Defines defines : light_kinds()) {
        for (const char* layer : {"0", "1", "2", "3"}) {
            defines["LAYER"] = layer;
            compute("rsm_layer_view.comp", defines);
        }
    }
}

TEST_F(Permutations, GBuffer) {
    for (const Defines& material : subsets(material_switches())) {
        raster("gbuffer.frag", material);
        for (const Defines& emission :
             subsets({"EMISSION", "EMISSION_TEXTURE"}, with(material, {"WRITE_EMISSION"}))) {
            raster("gbuffer.frag", emission);
        }
    }
}

TEST_F(Permutations, Rsm) {
    for (const Defines& material : subsets(material_switches(), with(light_kinds()[0], {"LIGHT_VIEW"}))) {
        raster("rsm.frag", material);
    }
    // The light's part and the material's part of the shader do not depend on each other.
    for (const Defines& light : light_kinds()) {
        raster("rsm.frag", with(light, {"LIGHT_VIEW"}));
        raster("rsm.frag", with(with(light, {"LIGHT_VIEW"}), material_switches()));
    }
}

TEST_F(Permutations, ShadowMap) {
    raster("shadow_map.frag", {{"DEPTH_ONLY", "1"}});
    for (const Defines& defines :
         subsets({"BASE_COLOR_TEXTURE", "VERTEX_COLOR"}, {{"DEPTH_ONLY", "1"}, {"ALPHA_TEST", "1"}})) {
        raster("shadow_map.frag", defines);
    }
}

TEST_F(Permutations, Display) {
    for (const Defines& defines : subsets({"LATTICE"})) {
        EXPECT_NO_THROW(
            Program("display",
                    {{GL_VERTEX_SHADER, "passes/display.vert"}, {GL_FRAGMENT_SHADER, "passes/display.frag"}},
                    defines))
            << describe(defines);
    }
}

}  // namespace
}  // namespace bounce::gl
