// SPDX-License-Identifier: Apache-2.0
//
// The references of an evaluation's frames: found in the cache, given as images, or rendered with Cycles.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "evaluate/cycles_runner.h"
#include "evaluate/reference.h"
#include "evaluate/reference_growth.h"
#include "evaluate/render_cache.h"
#include "evaluate/scratch_folder.h"

namespace bounce {

class ReferenceSet {
  public:
    struct Source {
        std::filesystem::path scene;  // .blend, .glb or .gltf
        std::string scene_hash;       // of its content
        std::vector<int> frames;
        int width = 0;
        int height = 0;
        int bounces = 1;
        ReferenceGoal goal;
        std::string given;              // image files, #### for the frame's number; empty: Cycles renders
        std::filesystem::path blender;  // empty where the references are given
        std::string blender_version;
        std::string render_hash;  // of what Blender's renders of the scene depend on, for the cache
    };
    // The key of a finished picture of Cycles in the render cache.
    using CyclesKey = std::function<std::string(const CyclesRender&)>;
    // The least relMSE that anything has against an image taken as the frame's reference; infinite where
    // there is nothing to measure.
    using SmallestError = std::function<double(int frame, const Image& reference)>;

    // Loads what is given or cached. folder: of the cached references. Throws input_error where a given image
    // is not of this scene, frame, size or number of bounces.
    ReferenceSet(Source source, std::filesystem::path folder, const RenderCache& renders, CyclesKey key);

    // Renders with Cycles what the goal asks for, batch by batch. Each batch is kept as soon as it is whole.
    // Returns what Blender told of the last job, nothing where it was not started. Throws input_error where
    // Cycles cannot render the scene or its picture has values that are not numbers.
    std::optional<CyclesReport> render(const SmallestError& smallest_error);

    // Whether a frame has none yet, so that Cycles must render one.
    [[nodiscard]] bool lacks_any() const;

    [[nodiscard]] const Reference& at(int frame) const { return *references_.at(frame); }
    [[nodiscard]] std::vector<Reference> all() const;

  private:
    struct Batch {
        int frame;
        int spp;
        std::array<int, 2> seeds;
    };

    [[nodiscard]] ReferenceKey key_of(int frame) const;
    [[nodiscard]] std::vector<Batch> missing_batches(const SmallestError& smallest_error) const;
    CyclesReport render(const std::vector<Batch>& batches);
    void add(const Batch& batch, const CyclesRender& half1, const CyclesRender& half2,
             const std::vector<std::filesystem::path>& scene_files);
    void warn_of_high_floors(const SmallestError& smallest_error) const;

    Source source_;
    std::filesystem::path folder_;
    const RenderCache& renders_;
    CyclesKey key_;
    ScratchFolder scratch_;
    std::map<int, std::optional<Reference>> references_;
};

}  // namespace bounce
