// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gl/buffer.h"
#include "gpu/render_space.h"
#include "gpu/shared_types.h"
#include "gpu/vertex_store.h"
#include "scene/points/ground.h"
#include "scene/points/hull.h"
#include "scene/points/point_set.h"

namespace bounce::gpu {

// A run of points, as they stand in the buffer of sources.
struct PointRun {
    uint32_t first = 0;
    uint32_t count = 0;
};

// The scene's points on the GPU: which triangle each lies on, uploaded once, and where it is at this pose,
// which the point update pass writes for surfaces that changed.
class PointStore {
  public:
    PointStore(const scene::Scene& scene, int animation);

    // drop_hull: surfaces on the scene's hull hide nothing within the scene. thin_ground: reflectors are the
    // more thinly spread on the ground (scene/points/ground.h, where the animation begins) the farther it
    // lies from all else. Samples points where the counts or the surfaces on the hull changed, and finds out
    // what moved since update_done() was last called.
    void set_pose(const scene::Pose& pose, const RenderSpace& space, const VertexStore& vertices,
                  const scene::PointCounts& wanted, bool drop_hull, bool thin_ground);

    // Where it only plans, set_pose() makes no buffers of the points but says how large they would be; they
    // are made by the next one that does not.
    void plan_only(bool plans) { plans_only_ = plans; }
    // Of what set_pose() made or, where it only plans, would have made.
    [[nodiscard]] size_t bytes() const { return bytes_; }
    // Of what there is.
    [[nodiscard]] size_t allocated_bytes() const;

    // Sources whose surfaces changed; and whether those of large triangles did.
    [[nodiscard]] const std::vector<PointRun>& changed() const { return changed_; }
    // What decides on the points and large triangles of this pose, and on their materials' places.
    [[nodiscard]] const ContentKey& content() const { return content_; }
    [[nodiscard]] bool any_changed() const { return upload_due_ || !changed_.empty() || large_changed_; }
    void update_done();

    [[nodiscard]] size_t large_triangles() const { return set_.large.size(); }
    // Those that hide something within the scene; they stand first.
    [[nodiscard]] size_t large_triangles_inside() const;
    [[nodiscard]] size_t occluders() const { return set_.occluders.size(); }
    [[nodiscard]] size_t reflectors() const { return set_.reflectors.size(); }
    [[nodiscard]] double occluder_area_m2() const { return set_.occluder_area_m2; }
    [[nodiscard]] double reflector_area_m2() const { return set_.reflector_area_m2; }
    [[nodiscard]] double dense_reflector_area_m2() const { return set_.dense_reflector_area_m2; }
    // One entry a part of parts(): whether it lies on the scene's hull at this pose; none where drop_hull is
    // not.
    [[nodiscard]] std::vector<bool> on_hull(const scene::Pose& pose, bool drop_hull);
    // Area of what may hide something at this pose, before any point is sampled; metres^2.
    [[nodiscard]] double occluding_area_m2(const scene::Pose& pose, bool drop_hull);
    // Of this pose; see scene/points/ground.h.
    [[nodiscard]] scene::Ground ground(const scene::Pose& pose);
    // The same where the animation begins: of the scene alone, whichever frame is drawn.
    [[nodiscard]] const scene::Ground& first_ground();
    [[nodiscard]] const scene::SurfaceParts& parts() const { return parts_; }

    // uvec4 a point (shaders/lib/points.glsl): occluders, then reflectors.
    [[nodiscard]] gl::Buffer& points() { return points_; }
    // Three vec4 a triangle, render space.
    [[nodiscard]] gl::Buffer& triangles() { return triangles_; }
    void bind_for_update() const;
    // Materials and surfaces of the points, for shaders/lib/irsm.glsl.
    void bind_materials() const;
    void bind_for_triangle_update() const;
    // GpuPointSurface of each of parts().surfaces at this pose.
    void bind_surfaces() const { surface_buffer_.bind_storage(SSBO_POINT_SURFACES); }
    // A triangle's corners in the stream of positions, and its surface.
    [[nodiscard]] glm::uvec4 place(uint32_t surface, const glm::uvec3& triangle,
                                   const VertexStore& vertices) const;

  private:
    void upload_materials();
    void upload(const VertexStore& vertices);
    void find_changes(const std::vector<GpuPointSurface>& now);
    [[nodiscard]] scene::Thinning thinning();

    const scene::Scene& scene_;
    int animation_ = 0;
    scene::SurfaceParts parts_;
    scene::HullFinder hull_finder_;
    std::vector<bool> on_hull_;
    std::vector<bool> sampled_on_hull_;
    std::vector<scene::DrawInstance> hull_draws_;  // of the pose that on_hull_ is for
    scene::PointSet set_;
    scene::PointCounts wanted_;
    bool thinned_ = false;
    std::optional<scene::Ground> first_ground_;
    std::vector<PointRun> surface_runs_;  // one a surface
    std::vector<GpuPointSurface> surfaces_;
    std::vector<GpuPointSurface> updated_surfaces_;   // that points stand on
    std::vector<GpuPointSurface> uploaded_surfaces_;  // in surface_buffer_
    std::vector<PointRun> changed_;
    uint32_t samplings_ = 0;  // how often points were sampled
    ContentKey content_, deformed_, updated_deformed_;
    bool large_changed_ = false;
    bool plans_only_ = false;
    bool upload_due_ = false;
    size_t bytes_ = 0;
    gl::Buffer triangle_sources_, triangles_, point_materials_;
    gl::Buffer sources_, surface_buffer_, points_;
    const gl::Buffer* positions_ = nullptr;
};

}  // namespace bounce::gpu
