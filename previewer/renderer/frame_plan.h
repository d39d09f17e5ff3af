// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "renderer/settings.h"
#include "scene/pose.h"

namespace bounce {

struct LeftOut {
    std::string pass;
    std::string reason;
};

// What this frame does, decided without OpenGL from what the pose holds and what the settings ask for.
struct FramePlan {
    bool deform = false;
    bool direct = false;
    bool indirect = false;        // any bounced light
    bool vpls = false;            // bounced light by virtual point lights
    bool occluded = false;        // these, or those of the world's bounces, are occluded
    bool hybrid = false;          // gathered where simplified meshes are seen
    bool simplified = false;      // some pass draws simplified meshes
    int bounces = 0;              // of light by virtual point lights
    bool glossy = false;          // with the glossy lobes of lights and receivers
    bool narrow_lobes = false;    // some so narrow that they change within a block of interleaved pixels
    bool close_maps = false;      // bare places in maps of disks are closed
    bool close_world = false;     // and in those of the world's lights
    bool near_field = false;      // what is near the lights is gathered from the RSMs
    bool temporal_reuse = false;  // bounced light of the frames before goes on
    bool interpolate = false;
    bool antialias = false;
    bool emission = false;
    bool world_light = false;     // the world is not black
    bool world_occluded = false;  // and stands as virtual point lights
    bool environment = false;     // and drawn with its image
    int world_bounces = 0;        // of its light
    bool receives = false;        // some surface reflects light, by whatever lobe
    bool emitters = false;        // emissive surfaces light others
    int emitter_bounces = 0;      // of their light
    bool emitters_occluded = false;
    bool blends = false;             // blended surfaces have layers of their own
    bool veils = false;              // and there are some
    int blend_layers = 0;            // at most so many, where there are any
    bool avg = false;                // the approximate visibility grid is filled
    bool traced = false;             // the first bounce's lights are where rays from the lights meet it
    bool motion = false;             // nothing but where surfaces were in the frame before
    std::vector<int> lights;         // into Pose::light_instances, those that send light
    std::vector<bool> takes_light;   // per entry of `lights`: power below 0; it has no bounce
    std::vector<bool> shadows;       // per entry of `lights`
    std::vector<bool> soft;          // the same: those whose shadow has a penumbra
    bool imperfect_shadows = false;  // of these some have imperfect maps
    std::vector<int> places;         // parallel to `lights`: that its bounced light starts from
    std::vector<bool>
        veiled;  // the same: those that blended surfaces let a part of through, though their shadow is hard
    std::vector<LeftOut> left_out;            // and why
    std::vector<std::string> notes;           // why the picture lacks what was asked for
    std::vector<std::string> approximations;  // where the picture knowingly differs from Cycles
};

// What decides whether a penumbra can be seen, and which lights are large.
struct Sight {
    scene::Bounds bounds;           // of the pose, world space
    double finest_pixel_m = 0.0;    // penumbra.h
    double scene_diagonal_m = 0.0;  // of the whole animation
};

// sight: where it is null, every penumbra counts as seen and no light as large.
[[nodiscard]] FramePlan plan_frame(const scene::Scene& scene, const scene::Pose& pose,
                                   const Settings& settings, const Sight* sight = nullptr);

}  // namespace bounce
