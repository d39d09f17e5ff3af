// SPDX-License-Identifier: Apache-2.0
#include "gpu/gpu_scene.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <numeric>
#include <tuple>

#include "scene/transparency.h"

namespace bounce::gpu {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

// Texture and data of a reference that names a texture without an image count as absent.
bool usable(const scene::Scene& scene, const scene::TextureRef& ref) {
    return ref.present() && scene.textures[at(ref.texture)].image != scene::k_none;
}

GpuMaterial pack(const scene::Material& material, bool from_blender) {
    GpuMaterial out{};
    out.base_color = material.base_color;
    out.emission = glm::vec4(material.emission * material.emission_strength, material.alpha_cutoff);
    out.surface = {material.metallic, material.roughness, material.specular, material.normal_scale};
    out.flags = {material.diffuse == scene::DiffuseModel::disney ? DIFFUSE_DISNEY : DIFFUSE_LAMBERT,
                 material.unlit ? 1 : 0, from_blender ? 1 : 0, 0};
    const scene::TextureRef* refs[4] = {&material.base_color_texture, &material.metallic_roughness_texture,
                                        &material.normal_texture, &material.emission_texture};
    for (int i = 0; i < 4; ++i) {
        const glm::mat3& m = refs[i]->uv_transform;
        out.uv[2 * i] = {m[0][0], m[1][0], m[2][0], static_cast<float>(refs[i]->uv_set)};
        out.uv[2 * i + 1] = {m[0][1], m[1][1], m[2][1], 0.0F};
    }
    return out;
}

DrawFeatures features_of(const scene::Scene& scene, const MaterialTextures& textures,
                         const scene::Material& material, const scene::Primitive& primitive) {
    DrawFeatures features;
    const auto textured = [&](const scene::TextureRef& ref) {
        return usable(scene, ref) && !(ref.uv_set == 0 ? primitive.uv0 : primitive.uv1).empty();
    };
    features.base_color_texture = textured(material.base_color_texture);
    features.metallic_roughness_texture = textured(material.metallic_roughness_texture);
    features.normal_texture = textured(material.normal_texture) && !primitive.tangents.empty();
    features.emission = material.emission * material.emission_strength != glm::vec3(0.0F) || material.unlit;
    features.emission_texture = features.emission && textured(material.emission_texture);
    features.base_color_encoded =
        features.base_color_texture && textures.stays_encoded(material.base_color_texture, true);
    features.metallic_roughness_encoded = features.metallic_roughness_texture &&
                                          textures.stays_encoded(material.metallic_roughness_texture, false);
    features.normal_encoded =
        features.normal_texture && textures.stays_encoded(material.normal_texture, false);
    features.emission_encoded =
        features.emission_texture && textures.stays_encoded(material.emission_texture, true);
    const scene::Coverage coverage = scene::coverage(scene, material, primitive);
    features.blend = coverage.blended;
    features.solid = coverage.solid;
    features.alpha_test = material.alpha_mode == scene::AlphaMode::mask || coverage.blended;
    features.vertex_color = !primitive.colors.empty();
    return features;
}

// All that leaves the surface's look the same to the bit; a flat normal map would round, and so would white
// vertex colours on their way across a triangle.
void force(DrawFeatures& features, const scene::Material& material) {
    features.base_color_texture = features.metallic_roughness_texture = true;
    features.emission = features.emission_texture = true;
    features.alpha_test |= !features.blend && material.base_color.a >= 1.0F;
}

// Rows of the affine matrix, and of the cofactor matrix of its linear part, which turns normals right
// under any scale, singular and mirroring ones included (it is det * inverse transpose).
GpuDraw pack_draw(const glm::dmat4& m, int material) {
    GpuDraw draw{};
    for (int row = 0; row < 3; ++row) {
        draw.render_from_model[row] = glm::vec4(glm::dvec4(m[0][row], m[1][row], m[2][row], m[3][row]));
    }
    const glm::dvec3 x(m[0]);
    const glm::dvec3 y(m[1]);
    const glm::dvec3 z(m[2]);
    // Normalised so that tiny and huge scales stay in float's range; only the direction counts.
    const double largest = std::max({glm::length(x), glm::length(y), glm::length(z), 1e-300});
    const glm::dmat3 cofactor(glm::cross(y / largest, z / largest), glm::cross(z / largest, x / largest),
                              glm::cross(x / largest, y / largest));
    const double sign = glm::dot(glm::cross(x / largest, y / largest), z / largest) < 0.0 ? -1.0 : 1.0;
    for (int row = 0; row < 3; ++row) {
        draw.normal_from_model[row] = glm::vec4(
            glm::dvec4(sign * cofactor[0][row], sign * cofactor[1][row], sign * cofactor[2][row], 0.0));
    }
    draw.ids = {material, sign < 0.0 ? 1 : 0, 0, 0};
    return draw;
}

// The same in every frame, whatever else is drawn: what noise hangs on must not jump.
int draw_number(const scene::DrawInstance& instance, int primitive, int copy) {
    return ((instance.node * 31 + primitive) * 31 + copy) & 0x7fffff;
}

bool same_material(const scene::Material& a, const scene::Material& b) {
    return a.base_color == b.base_color && a.metallic == b.metallic && a.roughness == b.roughness &&
           a.emission == b.emission && a.emission_strength == b.emission_strength;
}

// The most that a length of the model becomes in render space. A skin's joints are taken to be as large as
// the first.
double model_scale(const scene::Pose& pose, const scene::DrawInstance& instance,
                   const glm::dmat4& render_from_vertices, const RenderSpace& space) {
    glm::dmat4 m = render_from_vertices;
    if (instance.skin != scene::k_none && !pose.skins[at(instance.skin)].empty()) {
        m = space.render_from_world() * pose.skins[at(instance.skin)].front();
    }
    return std::max(
        {glm::length(glm::dvec3(m[0])), glm::length(glm::dvec3(m[1])), glm::length(glm::dvec3(m[2]))});
}

}  // namespace

GpuScene::GpuScene(const scene::Scene& scene) : scene_(scene), vertices_(scene), textures_(scene) {
    const scene::Pose first = scene::evaluate_pose(scene, 0.0);
    space_ = RenderSpace::around(scene::world_bounds(scene, first));
}

void GpuScene::upload_materials(const std::vector<scene::Material>& materials) {
    const bool unchanged =
        current_materials_.size() == materials.size() && materials_ &&
        std::equal(materials.begin(), materials.end(), current_materials_.begin(), same_material);
    if (unchanged) {
        return;
    }
    std::vector<GpuMaterial> packed;
    for (const scene::Material& material : materials) {
        packed.push_back(pack(material, scene_.from_blender));
    }
    packed.push_back(
        pack(scene::Material{}, scene_.from_blender));  // glTF's default, for primitives that name none
    if (materials_.bytes() != packed.size() * sizeof(GpuMaterial)) {
        materials_ = gl::Buffer("materials", packed.size() * sizeof(GpuMaterial), GL_DYNAMIC_STORAGE_BIT);
    }
    materials_.update(std::span<const GpuMaterial>(packed));
    material_contents_.clear();
    for (const GpuMaterial& material : packed) {
        material_contents_.push_back(ContentHash().add(material).key());
    }
    current_materials_ = materials;
}

void GpuScene::set_pose(const scene::Pose& pose) {
    if (forced_ && !white_) {
        // Of floats: filters of 8 bits may round a little below 1.
        white_ = gl::Texture("white", {.format = GL_RGBA32F, .width = 1, .height = 1});
        const std::array<float, 4> white = {1.0F, 1.0F, 1.0F, 1.0F};
        glTextureSubImage2D(white_.id(), 0, 0, 0, 1, 1, GL_RGBA, GL_FLOAT, white.data());
    }
    bounds_ = scene::world_bounds(scene_, pose);
    upload_materials(pose.materials);
    vertices_.set_pose(pose, space_);
    build_batches(pose);
}

glm::dmat4 GpuScene::render_from_vertices(const scene::DrawInstance& instance, int primitive) const {
    const bool joints = !scene_.meshes[at(instance.mesh)].primitives[at(primitive)].joints.empty();
    const bool skinned = joints && instance.skin != scene::k_none && vertices_.node_deforms(instance.node);
    return skinned ? glm::dmat4(1.0) : space_.render_from_world() * instance.world_from_model;
}

void GpuScene::build_batches(const scene::Pose& pose) {
    static const scene::Material default_material;
    // Draws that share every state stand together, so that they become one instanced call.
    struct Item {
        DrawBatch batch;
        GpuDraw draw;
        DrawBox box;
        DrawSource source;
        double scale = 1.0;
        ContentKey deformed;
    };
    std::vector<Item> items;
    std::vector<int> copies(scene_.nodes.size(), 0);
    has_emission_ = has_disney_ = has_specular_ = has_blended_ = false;
    triangles_ = 0;
    for (size_t i = 0; i < pose.draws.size(); ++i) {
        const scene::DrawInstance& instance = pose.draws[i];
        const scene::Mesh& mesh = scene_.meshes[at(instance.mesh)];
        const bool deformed = vertices_.node_deforms(instance.node);
        ++copies[at(instance.node)];
        for (size_t p = 0; p < mesh.primitives.size(); ++p) {
            const scene::Primitive& primitive = mesh.primitives[p];
            if (primitive.indices.empty()) {
                continue;
            }
            const bool has_material = primitive.material != scene::k_none;
            const scene::Material& material =
                has_material ? pose.materials[at(primitive.material)] : default_material;
            if (!scene::coverage(scene_, material, primitive).visible) {
                continue;
            }
            const int material_index =
                has_material ? primitive.material : static_cast<int>(pose.materials.size());
            const glm::dmat4 transform = render_from_vertices(instance, static_cast<int>(p));
            const PrimitiveRange range = deformed
                                             ? vertices_.deformed_range(instance.node, static_cast<int>(p))
                                             : vertices_.range(instance.mesh, static_cast<int>(p));
            Item item;
            item.batch.features = features_of(scene_, textures_, material, primitive);
            if (forced_) force(item.batch.features, material);
            item.batch.cull_back_faces = !material.double_sided && !scene_.from_blender;
            item.batch.mirrored = glm::determinant(glm::dmat3(transform)) < 0.0;
            item.batch.material = material_index;
            item.batch.first_index = range.first_index;
            item.batch.index_count = range.index_count;
            item.batch.base_vertex = range.base_vertex;
            item.batch.mesh = instance.mesh;
            item.batch.primitive = static_cast<int>(p);
            item.scale = model_scale(pose, instance, transform, space_);
            item.draw = pack_draw(transform, material_index);
            item.draw.ids.z = draw_number(instance, static_cast<int>(p), copies[at(instance.node)]);
            scene::Bounds world;
            scene::grow_by_primitive(world, pose, instance, primitive.bounds);
            item.box = gpu::draw_box(world, space_);
            item.source = {static_cast<int>(i), static_cast<int>(p)};
            item.deformed = vertices_.content(instance.node);
            items.push_back(item);
            has_blended_ |= item.batch.features.blend;
            has_emission_ |= item.batch.features.emission;
            has_disney_ |= material.diffuse == scene::DiffuseModel::disney;
            has_specular_ |= material.specular > 0.0F || material.metallic > 0.0F;
            triangles_ += primitive.indices.size() / 3;
        }
    }
    const auto key = [](const Item& item) {
        const DrawBatch& b = item.batch;
        return std::tuple(b.features, b.cull_back_faces, b.mirrored, b.material, b.first_index,
                          b.base_vertex);
    };
    std::stable_sort(items.begin(), items.end(),
                     [&](const Item& a, const Item& b) { return key(a) < key(b); });

    batches_.clear();
    draw_boxes_.clear();
    draw_sources_.clear();
    draw_data_.clear();
    draw_scales_.clear();
    draw_contents_.clear();
    ContentHash all;
    for (size_t i = 0; i < items.size(); ++i) {
        if (i == 0 || key(items[i]) != key(items[i - 1])) {
            batches_.push_back(items[i].batch);
            batches_.back().first_draw = static_cast<uint32_t>(i);
        }
        ++batches_.back().draw_count;
        draw_data_.push_back(items[i].draw);
        draw_scales_.push_back(items[i].scale);
        const DrawBatch& batch = items[i].batch;
        draw_contents_.push_back(ContentHash()
                                     .add(items[i].draw)
                                     .add(batch.first_index)
                                     .add(batch.index_count)
                                     .add(batch.base_vertex)
                                     .add(items[i].deformed)
                                     .key());
        all.add(draw_contents_.back());
        draw_boxes_.push_back(items[i].box);
        draw_sources_.push_back(items[i].source);
    }
    all.add_all(std::span<const ContentKey>(material_contents_));
    content_ = all.key();
    upload_draws();
}

ContentKey GpuScene::draw_content(uint32_t draw, Geometry geometry) const {
    if (geometry == Geometry::whole || !simplified_by_) {
        return draw_contents_[draw];
    }
    // How far its surfaces moved is in its data since it is simplified.
    return ContentHash().add(draw_contents_[draw]).add(draw_data_[draw].ids).add(simplified_count_).key();
}

void GpuScene::upload_draws() {
    if (draw_data_.size() > draw_capacity_ || !draws_) {
        draw_capacity_ = std::max<size_t>(draw_data_.size(), 1);
        draws_ = gl::Buffer("draws", draw_capacity_ * sizeof(GpuDraw), GL_DYNAMIC_STORAGE_BIT);
        std::vector<uint32_t> ids(draw_capacity_);
        std::iota(ids.begin(), ids.end(), 0U);
        draw_ids_ = gl::Buffer::of("draw ids", std::span<const uint32_t>(ids));
        vertices_.set_draw_ids(draw_ids_);
    }
    draws_.update(std::span<const GpuDraw>(draw_data_));
    single_draws_.clear();
    for (DrawBatch& batch : batches_) {
        if (batch.draw_count == 1) {
            batch.single = single_draws_.add(draw_data_[batch.first_draw]);
        }
    }
    single_draws_.upload();
}

void GpuScene::simplify(const scene::Simplification& settings) {
    if (simplified_by_ != settings) {
        simplified_ = scene::simplify_scene(scene_, settings);
        vertices_.set_simplified(simplified_);
        simplified_by_ = settings;
        ++simplified_count_;
    }
    simplified_triangles_ = 0;
    simplified_error_m_ = 0.0;
    for (DrawBatch& batch : batches_) {
        const PrimitiveRange range = vertices_.simplified_range(batch.mesh, batch.primitive);
        batch.simplified_first_index = range.first_index;
        batch.simplified_index_count = range.index_count;
        simplified_triangles_ += size_t{batch.draw_count} * (range.index_count / 3);
        const double error = simplified_[at(batch.mesh)][at(batch.primitive)].error_model;
        for (uint32_t draw = batch.first_draw; draw < batch.first_draw + batch.draw_count; ++draw) {
            const double moved = error * draw_scales_[draw];
            draw_data_[draw].ids.w = std::bit_cast<int>(static_cast<float>(moved));
            simplified_error_m_ = std::max(simplified_error_m_, moved / space_.scale);
        }
    }
    upload_draws();
}

void GpuScene::bind() const {
    vertices_.bind_vertex_array();
    draws_.bind_storage(SSBO_DRAWS);
    materials_.bind_storage(SSBO_MATERIALS);
}

void GpuScene::bind_material(const DrawBatch& batch) const {
    if (forced_) {
        for (const GLuint unit : {TEX_BASE_COLOR, TEX_METALLIC_ROUGHNESS, TEX_EMISSION}) {
            white_.bind(unit);
            glBindSampler(unit, 0);
        }
    }
    if (batch.material >= static_cast<int>(scene_.materials.size())) {
        return;
    }
    const scene::Material& material = scene_.materials[at(batch.material)];
    if (batch.features.base_color_texture) textures_.bind(TEX_BASE_COLOR, material.base_color_texture, true);
    if (batch.features.metallic_roughness_texture) {
        textures_.bind(TEX_METALLIC_ROUGHNESS, material.metallic_roughness_texture, false);
    }
    if (batch.features.normal_texture) textures_.bind(TEX_NORMAL, material.normal_texture, false);
    if (batch.features.emission_texture) textures_.bind(TEX_EMISSION, material.emission_texture, true);
}

int GpuScene::base_color_uv_set(const DrawBatch& batch) const {
    return batch.material < static_cast<int>(scene_.materials.size())
               ? scene_.materials[at(batch.material)].base_color_texture.uv_set
               : 0;
}

void GpuScene::draw(const DrawBatch& batch, uint32_t first, uint32_t count, Geometry geometry) {
    const bool whole = geometry == Geometry::whole;
    const uint32_t first_index = whole ? batch.first_index : batch.simplified_first_index;
    const uint32_t index_count = whole ? batch.index_count : batch.simplified_index_count;
    const auto* offset = reinterpret_cast<const void*>(  // NOLINT: OpenGL takes the offset as a pointer
        static_cast<uintptr_t>(first_index) * sizeof(uint32_t));
    glDrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, static_cast<GLsizei>(index_count),
                                                  GL_UNSIGNED_INT, offset, static_cast<GLsizei>(count),
                                                  batch.base_vertex, first);
}

}  // namespace bounce::gpu
