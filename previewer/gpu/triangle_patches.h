// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "gl/buffer.h"
#include "gpu/gpu_scene.h"
#include "gpu/point_store.h"

namespace bounce::gpu {

// Which triangles are made into points.
enum class PatchCover {
    all,
    inside,  // those that may hide a place of the scene from another: none on its hull
};

// A scene's draws as patches for tessellation: which triangles stay out, and which draws may have some so
// large that one patch does not give all their points. Nothing is kept of the points themselves.
class TrianglePatches {
  public:
    // Consecutive draws, numbered as DrawBatch::first_draw, that have a triangle to be drawn.
    struct Run {
        uint32_t first = 0;
        uint32_t count = 0;
    };

    // After both have this pose. drop_hull: whether PatchCover::inside is any different.
    void set_pose(const scene::Pose& pose, const GpuScene& scene, PointStore& points, bool drop_hull);

    // Of a batch of the scene.
    [[nodiscard]] const std::vector<Run>& runs(size_t batch, PatchCover cover) const {
        return runs_[static_cast<size_t>(cover)][batch];
    }
    // No triangle of the batch's draws has a larger area, nor have all of a draw's together more than the
    // second, squared render units; infinite where that is not known.
    [[nodiscard]] double largest_triangle(size_t batch) const { return largest_[batch]; }
    [[nodiscard]] double draw_area(size_t batch) const { return areas_[batch]; }
    // Whether single triangles of draws are left out: bind_dropped() says which.
    [[nodiscard]] bool drops_triangles(PatchCover cover) const {
        return cover == PatchCover::inside && drops_;
    }
    void bind_dropped() const { dropped_.bind_storage(SSBO_PATCH_DROPPED); }

  private:
    struct Extent {
        double largest = 0.0;  // triangle, squared model units
        double sum = 0.0;
    };
    void find_dropped(const scene::Pose& pose, const GpuScene& scene, PointStore& points, bool drop_hull);
    void find_sizes(const scene::Pose& pose, const GpuScene& scene);
    [[nodiscard]] const Extent& extent(const scene::Scene& scene, int mesh, int primitive);

    std::vector<std::vector<Run>> runs_[2];
    std::vector<double> largest_, areas_;
    std::vector<std::vector<Extent>> extents_;  // of each mesh's primitives; negative before they are known
    // What words_ was made for: it is made anew where that is no more the same.
    std::vector<bool> on_hull_;
    std::vector<size_t> drawn_surfaces_;
    std::vector<uint32_t> words_;  // shaders/lib/patch.glsl: DroppedBlock
    gl::Buffer dropped_;
    bool drops_ = false;
};

}  // namespace bounce::gpu
