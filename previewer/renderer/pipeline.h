// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "gpu/emitter_store.h"
#include "gpu/point_store.h"
#include "passes/avg_trace.h"
#include "passes/motion.h"
#include "passes/pass_context.h"
#include "passes/removed_light.h"
#include "passes/rsm_gather.h"
#include "passes/soft_shadow.h"
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

// The approximate visibility grid, yet to be filled, and what is traced through it.
struct AvgInputs {
    passes::AvgGrid grid;
    const gl::Buffer* numbers = nullptr;
    const gl::Buffer* rays = nullptr;  // where plan.traced
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
    std::vector<BounceStart> bounce_sources;  // in their order, one of each at least
    gpu::PointStore* points = nullptr;        // where the plan needs them
    std::vector<Bounce> bounces;              // plan.bounces of them
    Bounce world;                             // where plan.world_occluded; its lights' buffer:
    gl::Buffer* world_lights = nullptr;
    passes::WorldImage image;           // where plan.environment
    std::vector<Bounce> world_bounces;  // plan.world_bounces of them
    gpu::EmitterStore* emitter_store = nullptr;
    Bounce emitters;                      // where plan.emitters
    std::vector<Bounce> emitter_bounces;  // plan.emitter_bounces of them
    AvgInputs avg;                        // where plan.avg
    int triangles_inside = 0;             // large triangles in maps of lights within the scene
    passes::PreviousFrame previous;       // where the plan shows motion
    TextureHandle target;
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
