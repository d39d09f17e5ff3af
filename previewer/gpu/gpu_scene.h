// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "gl/buffer.h"
#include "gl/texture.h"
#include "gpu/draw_box.h"
#include "gpu/material_textures.h"
#include "gpu/render_space.h"
#include "gpu/shared_types.h"
#include "gpu/uniform_arena.h"
#include "gpu/vertex_store.h"
#include "scene/pose.h"
#include "scene/scene.h"

namespace bounce::gpu {

// What a batch of draws needs from its shader: absent features are compiled out.
struct DrawFeatures {
    bool base_color_texture = false;
    bool metallic_roughness_texture = false;
    bool normal_texture = false;
    bool emission_texture = false;
    bool emission = false;
    // Textures that the shader decodes from sRGB (MaterialTextures::stays_encoded()).
    bool base_color_encoded = false;
    bool metallic_roughness_encoded = false;
    bool normal_encoded = false;
    bool emission_encoded = false;
    bool alpha_test = false;
    bool blend = false;  // parts of it may be neither opaque nor nothing
    bool solid = true;   // parts of it may be opaque
    bool vertex_color = false;
    friend bool operator==(const DrawFeatures&, const DrawFeatures&) = default;
    friend auto operator<=>(const DrawFeatures&, const DrawFeatures&) = default;
};

// Which triangles of a scene are drawn.
enum class Geometry {
    whole,
    simplified,  // only after GpuScene::simplify()
};

// Instances of one primitive that share every state: one draw call.
struct DrawBatch {
    DrawFeatures features;
    bool cull_back_faces = false;
    bool mirrored = false;  // the transform turns front faces into back faces
    int material = 0;       // into GpuScene::materials
    uint32_t first_index = 0;
    uint32_t index_count = 0;
    int base_vertex = 0;
    int mesh = 0;  // into Scene::meshes, and into its primitives
    int primitive = 0;
    uint32_t simplified_first_index = 0;
    uint32_t simplified_index_count = 0;
    uint32_t first_draw = 0;
    uint32_t draw_count = 0;
    UniformArena::Slot single;  // GpuDraw, where draw_count is 1
};

// Which of the pose's draws an entry of the draw buffer is, and which of its mesh's primitives.
struct DrawSource {
    int instance = 0;
    int primitive = 0;
};

// The scene on the GPU: geometry, images and materials are uploaded once; set_pose uploads what a moment
// changes (transforms, materials that are animated, joints, weights).
class GpuScene {
  public:
    explicit GpuScene(const scene::Scene& scene);

    void set_pose(const scene::Pose& pose);
    // From the next pose on every branch that shaders have for materials is compiled in, with white textures,
    // whether a material needs it or not: the picture is the same.
    void force_features(bool forced) { forced_ = forced; }
    // Puts simplified meshes beside the whole ones, for the pose that is set. They are made when it is first
    // called, and where the settings change.
    void simplify(const scene::Simplification& settings);
    // Of the draws of the pose: triangles, and the largest distance a surface moved, metres. After
    // simplify().
    [[nodiscard]] size_t simplified_triangles() const { return simplified_triangles_; }
    [[nodiscard]] double simplified_error_m() const { return simplified_error_m_; }

    [[nodiscard]] const scene::Scene& source() const { return scene_; }
    [[nodiscard]] const RenderSpace& space() const { return space_; }
    // Bounds of the pose, world space.
    [[nodiscard]] const scene::Bounds& bounds() const { return bounds_; }
    [[nodiscard]] const std::vector<DrawBatch>& batches() const { return batches_; }
    // Of a draw, numbered as in DrawBatch::first_draw.
    [[nodiscard]] const DrawBox& draw_box(uint32_t draw) const { return draw_boxes_[draw]; }
    // In the order of the draw buffer: batches' first_draw counts in it.
    [[nodiscard]] const std::vector<DrawSource>& draw_sources() const { return draw_sources_; }
    // Places a primitive's vertices, which of skinned ones are in render space already.
    [[nodiscard]] glm::dmat4 render_from_vertices(const scene::DrawInstance& instance, int primitive) const;
    [[nodiscard]] bool deforms() const { return !vertices_.jobs().empty(); }
    void deform_done() { vertices_.deform_done(); }
    // What decides on a draw's triangles: where they stand and how they are deformed. Of a simplified scene
    // also by how much.
    [[nodiscard]] ContentKey draw_content(uint32_t draw, Geometry geometry) const;
    // What decides on the look of a batch's material.
    [[nodiscard]] const ContentKey& material_content(const DrawBatch& batch) const {
        return material_contents_[static_cast<size_t>(batch.material)];
    }
    // Of all draws and materials.
    [[nodiscard]] const ContentKey& content() const { return content_; }
    [[nodiscard]] bool has_emission() const { return has_emission_; }
    [[nodiscard]] bool has_disney_diffuse() const { return has_disney_; }
    // Anything neither opaque nor nothing.
    [[nodiscard]] bool has_blended() const { return has_blended_; }
    [[nodiscard]] bool has_specular() const { return has_specular_; }
    [[nodiscard]] size_t triangles_drawn() const { return triangles_; }
    [[nodiscard]] const VertexStore& vertices() const { return vertices_; }

    // Binds vertex arrays, draw and material buffers; then bind_single() where a batch is one draw, and
    // draw() with a program in use.
    void bind() const;
    void bind_materials() const { materials_.bind_storage(SSBO_MATERIALS); }
    void bind_vertex_array() const { vertices_.bind_vertex_array(); }
    void bind_single(const DrawBatch& batch) const { single_draws_.bind(UBO_DRAW, batch.single); }
    void bind_material(const DrawBatch& batch) const;
    // Which stream its base colour's texture is placed by, 0 or 1.
    [[nodiscard]] int base_color_uv_set(const DrawBatch& batch) const;
    // Only `count` of the batch's draws, from `first` on (numbered as first_draw).
    static void draw(const DrawBatch& batch, uint32_t first, uint32_t count, Geometry geometry);

  private:
    void upload_materials(const std::vector<scene::Material>& materials);
    void build_batches(const scene::Pose& pose);
    void upload_draws();

    const scene::Scene& scene_;
    RenderSpace space_;
    VertexStore vertices_;
    MaterialTextures textures_;
    std::vector<DrawBatch> batches_;
    std::vector<DrawBox> draw_boxes_;
    std::vector<DrawSource> draw_sources_;
    std::vector<GpuDraw> draw_data_;
    std::vector<ContentKey> draw_contents_;
    std::vector<ContentKey> material_contents_;
    ContentKey content_;
    std::vector<double> draw_scales_;  // render units a model unit, at most
    std::optional<scene::Simplification> simplified_by_;
    scene::SimplifiedMeshes simplified_;  // without their triangles
    uint32_t simplified_count_ = 0;       // how often they were made anew
    size_t simplified_triangles_ = 0;
    double simplified_error_m_ = 0.0;
    gl::Buffer draws_;
    UniformArena single_draws_;
    gl::Buffer draw_ids_;
    gl::Buffer materials_;
    size_t draw_capacity_ = 0;
    std::vector<scene::Material> current_materials_;
    scene::Bounds bounds_;
    bool has_emission_ = false;
    bool has_disney_ = false;
    bool has_specular_ = false;
    bool has_blended_ = false;
    bool forced_ = false;
    gl::Texture white_;  // where features are forced
    size_t triangles_ = 0;
};

}  // namespace bounce::gpu
