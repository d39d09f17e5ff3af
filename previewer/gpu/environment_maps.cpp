// SPDX-License-Identifier: Apache-2.0
#include "gpu/environment_maps.h"

#include <algorithm>
#include <bit>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "gpu/environment_brdf.h"
#include "scene/environment.h"

namespace bounce::gpu {
namespace {

constexpr int k_glossy_width = 256;  // of its first level
constexpr int k_brdf_size = 32;

struct Level {
    int width = 0;
    int height = 0;
    std::vector<float> rgba;
};

Level first_level(const scene::Environment& environment) {
    Level level{environment.width, environment.height, {}};
    const size_t texels = environment.rgb.size() / 3;
    level.rgba.resize(texels * 4);
    for (size_t i = 0; i < texels; ++i) {
        std::copy_n(&environment.rgb[3 * i], 3, &level.rgba[4 * i]);
        level.rgba[4 * i + 3] = 1.0F;
    }
    return level;
}

// Half as wide and high, rounded down as OpenGL's levels are; each texel averages what it covers, by solid
// angle.
Level next_level(const Level& from) {
    Level to{std::max(from.width / 2, 1), std::max(from.height / 2, 1), {}};
    to.rgba.resize(static_cast<size_t>(to.width) * static_cast<size_t>(to.height) * 4);
    const auto span = [](int i, int of, int in) {
        return std::pair(static_cast<int>(int64_t{i} * in / of), static_cast<int>(int64_t{i + 1} * in / of));
    };
    for (int y = 0; y < to.height; ++y) {
        const auto [top, bottom] = span(y, to.height, from.height);
        for (int x = 0; x < to.width; ++x) {
            const auto [left, right] = span(x, to.width, from.width);
            glm::dvec3 sum(0.0);
            double weights = 0.0;
            for (int j = top; j < bottom; ++j) {
                const double sr = scene::environment_texel_sr(from.width, from.height, j);
                for (int i = left; i < right; ++i) {
                    const float* rgba =
                        &from.rgba[4 * (static_cast<size_t>(j) * static_cast<size_t>(from.width) +
                                        static_cast<size_t>(i))];
                    sum += sr * glm::dvec3(rgba[0], rgba[1], rgba[2]);
                    weights += sr;
                }
            }
            float* out = &to.rgba[4 * (static_cast<size_t>(y) * static_cast<size_t>(to.width) +
                                       static_cast<size_t>(x))];
            for (int c = 0; c < 3; ++c) {
                out[c] = static_cast<float>(sum[c] / weights);
            }
            out[3] = 1.0F;
        }
    }
    return to;
}

void interpolate(const gl::Texture& texture, GLint wrap_s) {
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER,
                        texture.desc().levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, wrap_s);
}

}  // namespace

EnvironmentMaps::EnvironmentMaps(const scene::Environment& environment) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (std::max(environment.width, environment.height) > largest) {
        throw input_error(fmt::format(
            "the world's image {} is {} x {} pixels; this OpenGL takes {} a side: make it smaller",
            environment.name, environment.width, environment.height, largest));
    }
    const auto levels = static_cast<int>(
        std::bit_width(static_cast<unsigned>(std::max(environment.width, environment.height))));
    image = gl::Texture(
        "world image",
        {.format = GL_RGBA32F, .width = environment.width, .height = environment.height, .levels = levels});
    Level level = first_level(environment);
    for (int i = 0; i < image.desc().levels; ++i) {
        if (i > 0) {
            level = next_level(level);
        }
        glTextureSubImage2D(image.id(), i, 0, 0, level.width, level.height, GL_RGBA, GL_FLOAT,
                            level.rgba.data());
    }
    interpolate(image, GL_REPEAT);

    glossy = gl::Texture("world image, glossy", {.format = GL_RGBA32F,
                                                 .width = k_glossy_width,
                                                 .height = k_glossy_width / 2,
                                                 .levels = ENVIRONMENT_LEVELS});
    interpolate(glossy, GL_REPEAT);

    brdf = gl::Texture("world image, lobes",
                       {.format = GL_RGBA32F, .width = k_brdf_size, .height = k_brdf_size});
    const std::vector<glm::vec4> table = environment_brdf_table(k_brdf_size);
    glTextureSubImage2D(brdf.id(), 0, 0, 0, k_brdf_size, k_brdf_size, GL_RGBA, GL_FLOAT, table.data());
    interpolate(brdf, GL_CLAMP_TO_EDGE);
}

WorldUniforms EnvironmentMaps::uniforms(const glm::dmat3& render_from_environment, double strength) const {
    WorldUniforms out{};
    // Rows of the inverse are the rotation's columns.
    for (int i = 0; i < 3; ++i) {
        out.environment_from_render[i] = glm::vec4(glm::vec3(render_from_environment[i]), 0.0F);
    }
    out.environment_from_render[0].w = static_cast<float>(strength);
    out.detail = glm::vec4(static_cast<float>(std::numbers::pi / image.desc().height),
                           static_cast<float>(image.desc().levels - 1),
                           static_cast<float>(glossy.desc().levels - 1), 0.0F);
    return out;
}

}  // namespace bounce::gpu
