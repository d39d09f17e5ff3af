// SPDX-License-Identifier: Apache-2.0
//
// Flat rectangles that emit the same everywhere: lamp panels, light strips, plain screens. Each side of one
// is an area light, which is lit by in closed form and has shadows of real triangles, where points on it
// would make spots near by.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene/emission.h"
#include "scene/pose.h"
#include "scene/scene.h"

namespace bounce::scene {

// A rectangle of a mesh at one place where it is drawn.
struct EmissivePanel {
    int node = k_none;
    int instance = 0;  // into Node::instances
    int mesh = k_none;
    int primitive = 0;
    std::vector<glm::uvec3> triangles;  // that it is made of: vertices of the primitive
    glm::dvec3 center{0.0};             // model space
    glm::dvec3 half_x{0.0};
    glm::dvec3 half_y{0.0};  // x cross y points to where its triangles turn counter-clockwise
    EmittingSides sides;
};

struct EmissivePanels {
    std::vector<EmissivePanel> panels;
    bool all = false;  // nothing else may emit
};

// The rectangles with the most light, as the file stands, that have no more than `most_lights` sides in all.
// Rectangles that are textured, cut out, skinned or morphed are none, nor are those whose material never
// emits. The same whatever the time, so that no light turns from one kind into the other.
[[nodiscard]] EmissivePanels find_emissive_panels(const Scene& scene, size_t most_lights);

// The pose with an area light for each side of the panels that are drawn and still rectangles, after its
// other lights; and which panels these are. offset_m: how far before its surface a light stands, so that it
// does not hide it.
struct PanelPose {
    Pose pose;
    std::vector<EmissivePanel> lit;
};
[[nodiscard]] PanelPose with_panel_lights(const Scene& scene, const Pose& pose,
                                          std::span<const EmissivePanel> panels, double offset_m);

}  // namespace bounce::scene
