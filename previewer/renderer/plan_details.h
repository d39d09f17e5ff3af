// SPDX-License-Identifier: Apache-2.0
//
// What a frame's shaders and passes are spared, and why: the part of the plan that follows from what is
// drawn. Pure, without OpenGL.
#pragma once

#include <vector>

#include "renderer/frame_plan.h"

namespace bounce {

// An upper bound of what the materials that the pose draws reflect of the light that meets them, 0 to 1; a
// texture counts as white, and so does a surface with vertex colours. glossy: with what their glossy lobes
// reflect.
[[nodiscard]] double albedo_bound(const scene::Scene& scene, const scene::Pose& pose, bool glossy);

// Of so many bounces that were asked for, those after which less than k_least_bounced_share of the lights'
// own irradiance is still to come: each reflects at most albedo of the one before.
inline constexpr double k_least_bounced_share = 1e-3;
[[nodiscard]] int counted_bounces(int asked, double albedo);

// Branches of shaders that no visible surface needs, kinds of light that send none, and steps that the
// settings have no work for: to be appended to FramePlan::left_out.
[[nodiscard]] std::vector<LeftOut> absent_details(const scene::Scene& scene, const scene::Pose& pose,
                                                  const Settings& settings, const FramePlan& plan);

// Imperfect shadow maps are drawn from points; classic ones from triangles.
[[nodiscard]] bool splats_points(const FramePlan& plan, const Settings& settings);
// Further bounces are drawn from points; or traced through the approximate visibility grid.
[[nodiscard]] bool draws_from_points(const FramePlan& plan, const Settings& settings);
// Whether points of the scene are needed at all.
[[nodiscard]] bool points_needed(const FramePlan& plan, const Settings& settings);

}  // namespace bounce
