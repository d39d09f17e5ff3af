// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/content_key.h"
#include "gl/buffer.h"
#include "gl/object.h"
#include "gpu/render_space.h"
#include "gpu/shared_types.h"
#include "scene/pose.h"
#include "scene/scene.h"
#include "scene/simplify.h"

namespace bounce::gpu {

inline void delete_vertex_array(GLuint id) {
    glDeleteVertexArrays(1, &id);
}

// Where a primitive's vertices and indices lie.
struct PrimitiveRange {
    int base_vertex = 0;
    uint32_t first_index = 0;
    uint32_t index_count = 0;
};

// All geometry in one vertex array: a static region with every primitive once, and behind it a region that
// the deform pass rewrites each frame, with one copy for each skinned or morphing draw. Streams that no
// primitive has are not allocated.
class VertexStore {
  public:
    explicit VertexStore(const scene::Scene& scene);

    // True where a node's mesh is skinned or morphs: its draws use deformed_range.
    [[nodiscard]] bool node_deforms(int node) const { return !deformed_[static_cast<size_t>(node)].empty(); }
    [[nodiscard]] PrimitiveRange range(int mesh, int primitive) const {
        return ranges_[static_cast<size_t>(mesh)][static_cast<size_t>(primitive)];
    }
    [[nodiscard]] PrimitiveRange deformed_range(int node, int primitive) const {
        return deformed_[static_cast<size_t>(node)][static_cast<size_t>(primitive)];
    }
    // Puts fewer triangles of the same vertices beside all of them, in the place of those put there before.
    void set_simplified(const scene::SimplifiedMeshes& meshes);
    // Its vertices are those of range() or deformed_range(). Only after set_simplified().
    [[nodiscard]] PrimitiveRange simplified_range(int mesh, int primitive) const {
        return simplified_[static_cast<size_t>(mesh)][static_cast<size_t>(primitive)];
    }
    // Uploads joint matrices and morph weights of the pose, where they changed.
    void set_pose(const scene::Pose& pose, const RenderSpace& space);
    // What a node's vertices are made of at this pose; the same for all that do not deform.
    [[nodiscard]] const ContentKey& content(int node) const { return contents_[static_cast<size_t>(node)]; }
    // Of all together.
    [[nodiscard]] const ContentKey& content() const { return content_; }
    // Whether the deform pass has yet to run for this pose.
    [[nodiscard]] bool deform_due() const { return !jobs_.empty() && written_ != content_; }
    void deform_done() { written_ = content_; }

    [[nodiscard]] const std::vector<DeformJob>& jobs() const { return jobs_; }
    void bind_vertex_array() const { glBindVertexArray(vertex_array_.id()); }
    // Instance attribute with the draw's index, from 0 up to the count it was made for.
    void set_draw_ids(const gl::Buffer& ids) const;
    void bind_for_deform() const;
    // All streams but tangents, for shaders/lib/avg_triangle.glsl; what the scene lacks is left as it is.
    void bind_for_grid() const;
    // Three floats a vertex: model space, and of deformed vertices what the deform pass wrote.
    [[nodiscard]] const gl::Buffer& positions() const { return positions_; }
    // Of primitives' triangles, counted from their base vertices (PrimitiveRange).
    [[nodiscard]] const gl::Buffer& indices() const { return indices_; }
    // Two floats a vertex, and four; empty where no primitive has any.
    [[nodiscard]] const gl::Buffer& uvs(int set) const { return set == 0 ? uv0_ : uv1_; }
    [[nodiscard]] const gl::Buffer& colors() const { return colors_; }
    [[nodiscard]] bool has_tangents() const { return static_cast<bool>(tangents_); }

  private:
    struct Builder;
    void add_deformed_nodes(const scene::Scene& scene, Builder& build);
    void create(Builder& build);

    std::vector<std::vector<PrimitiveRange>> ranges_;
    std::vector<std::vector<PrimitiveRange>> deformed_;    // per node; empty where rigid
    std::vector<std::vector<PrimitiveRange>> simplified_;  // per mesh; empty where nothing is simplified
    size_t index_count_ = 0;                               // of all triangles
    std::vector<DeformJob> jobs_;
    std::vector<int> job_nodes_;
    std::vector<int> skin_first_matrix_;
    gl::Object<delete_vertex_array> vertex_array_;
    gl::Buffer positions_, normals_, tangents_, uv0_, uv1_, colors_, indices_;
    std::vector<ContentKey> contents_;  // per node
    std::vector<int> node_skins_;
    ContentKey content_, written_;  // written_: what the deform pass last ran for
    gl::Buffer jobs_buffer_, influences_, skin_matrices_, deltas_, weights_;
};

}  // namespace bounce::gpu
