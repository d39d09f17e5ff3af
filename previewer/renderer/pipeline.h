// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "gpu/emitter_store.h"
#include "gpu/point_store.h"
#include "passes/accumulate.h"
#include "passes/avg_trace.h"
#include "passes/motion.h"
#include "passes/pass_context.h"
#include "passes/removed_light.h"
#include "passes/rsm_gather.h"
#include "passes/soft_shadow.h"
#include "passes/sphere_vpls.h"
#include "passes/temporal_reuse.h"
#include "passes/vpl_sampling.h"
#include "renderer/frame_plan.h"
#include "renderer/settings.h"

namespace bounce {

// One bounce's lights, and the maps that the next one's are drawn from: counts, places and uniforms.
struct Bounce {
    passes::VplSet lights;
    passes::VplSet irsms;
};

// What bounced light starts from: a light, or a place on it.
struct BounceStart {
    size_t light = 0;  // in PipelineInputs::lights
    passes::LightPass pass;
    gpu::UniformArena::Slot gather_frame;  // FrameUniforms with its sample count
    const gl::Buffer* pattern = nullptr;
};

// Maps that a moment's lights cast once and for all, and that later pictures of the same moment look up
// again; empty where they are still to be drawn. Parallel to the lights, and to the sources of bounced light.
struct KeptMaps {
    std::vector<gl::Texture> hard;
    std::vector<gl::Texture> rsms;
    int shadow_size = 0;
    int rsm_size = 0;
};

// One of many pictures of a moment, whose mean is sought.
struct OneOfMany {
    uint32_t number = 1;     // from 1; each has other lights, points and pixels' parts of the lights
    float extent = 1.0F;     // VplSet::extent
    glm::vec2 offset{0.0F};  // CameraView::offset_px
    KeptMaps* kept = nullptr;
    passes::PictureMeans* means = nullptr;
};

// The approximate visibility grid, yet to be filled, and what is traced through it.
struct AvgInputs {
    passes::AvgGrid grid;
    const gl::Buffer* numbers = nullptr;
    const gl::Buffer* rays = nullptr;  // where plan.traced
    ContentKey rays_content;
};

struct PipelineInputs {
    const FramePlan& plan;
    const Settings& settings;
    passes::PassContext context;
    passes::View camera;
    std::vector<passes::LightPass> lights;  // parallel to plan.lights
    // Parallel to `lights`: imperfect maps of places on them, and the places' buffers; empty where there are
    // none.
    std::vector<passes::ImperfectMaps> imperfect;
    std::vector<gl::Buffer>* places = nullptr;
    std::vector<ContentKey> places_content;   // parallel to `places`
    std::vector<BounceStart> bounce_sources;  // in their order, one of each at least
    gpu::PointStore* points = nullptr;        // where the plan needs them
    std::vector<Bounce> bounces;              // plan.bounces of them
    Bounce world;                             // where plan.world_occluded; its lights' buffer:
    gl::Buffer* world_lights = nullptr;
    ContentKey world_content;     // of that
    passes::SphereSource sphere;  // where its lights are drawn from cells of the sphere; else without any
    passes::WorldImage image;     // where plan.environment
    std::vector<Bounce> world_bounces;  // plan.world_bounces of them
    gpu::EmitterStore* emitter_store = nullptr;
    Bounce emitters;                             // where plan.emitters
    std::vector<Bounce> emitter_bounces;         // plan.emitter_bounces of them
    passes::TessellatedPoints tessellated;       // where the splats of lights within the scene are made so
    passes::TessellatedPoints soft_tessellated;  // and in imperfect maps of places on lights
    AvgInputs avg;                               // where plan.avg
    int triangles_inside = 0;                    // large triangles in maps of lights within the scene
    passes::PreviousFrame previous;              // where the plan shows motion
    // Where plan.temporal_reuse: what is kept for the next frame, and taken of the one before.
    passes::KeptLight kept;
    std::optional<passes::LightBefore> light_before;
    passes::ReusedPixels* reused_pixels = nullptr;  // filled where it is there, for a wait
    TextureHandle target;
    const OneOfMany* one_of_many = nullptr;  // the picture is taken into its means as well
    // Filled where they are there, each for a wait.
    int* gathered_pixels = nullptr;
    passes::RemovedLight* removed = nullptr;
    float* reflected_flux =
        nullptr;  // of all reflective shadow maps, in no particular unit; 0: nothing is lit
    int* unpeeled_pixels = nullptr;  // that show more blended surfaces than there are layers
    bool* anything_seen = nullptr;   // whether the camera sees a surface
};

// Wires the passes of one frame. The only place that does: reading it top to bottom is reading the frame.
void build_pipeline(FrameGraph& graph, const PipelineInputs& inputs);

}  // namespace bounce
