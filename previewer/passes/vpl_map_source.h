// SPDX-License-Identifier: Apache-2.0
//
// Maps that virtual point lights are drawn from, as the passes that draw them see them.
#pragma once

#include <functional>
#include <vector>

#include "passes/pass_context.h"

namespace bounce::passes {

// One map, or maps of one kind.
struct MapSource {
    gl::Defines defines;
    int size = 0;  // texels a row
    int rows = 0;
    glm::vec2 share{0.0F, 1.0F};  // uniform: which part of the sequence's first coordinate is this source's
    std::function<void(PassBuilder&)> declare;
    ContentKey content;  // of all that bind() gives, but what declare() reads
    std::function<void(const PassResources&)> bind;

    [[nodiscard]] int texels() const { return rows * size; }
};

[[nodiscard]] inline gl::Defines with_lobes(gl::Defines defines, const PassContext& context, bool glossy) {
    if (glossy) defines["GLOSSY"] = "1";
    if (context.scene.has_disney_diffuse()) defines["DISNEY"] = "1";
    return defines;
}

// What decides on what is read of the maps, but for the graph's own.
[[nodiscard]] inline ContentHash hash_of(const std::vector<MapSource>& sources) {
    ContentHash hash;
    for (const MapSource& source : sources) {
        hash.add(content(source.defines)).add(glm::ivec2(source.size, source.rows)).add(source.share);
        hash.add(source.content);
    }
    return hash;
}

// Calls visit(source, its first row, its first texel) for one after the other.
template <typename Visit>
void for_each_map(const std::vector<MapSource>& sources, const Visit& visit) {
    int row = 0;
    int texel = 0;
    for (const MapSource& source : sources) {
        visit(source, row, texel);
        row += source.rows;
        texel += source.texels();
    }
}

[[nodiscard]] inline int rows_of(const std::vector<MapSource>& sources) {
    int rows = 0;
    for (const MapSource& source : sources) {
        rows += source.rows;
    }
    return rows;
}

[[nodiscard]] inline size_t texels_of(const std::vector<MapSource>& sources) {
    size_t texels = 0;
    for (const MapSource& source : sources) {
        texels += static_cast<size_t>(source.texels());
    }
    return texels;
}

}  // namespace bounce::passes
