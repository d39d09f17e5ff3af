// SPDX-License-Identifier: Apache-2.0
#include "gpu/vertex_store.h"

#include <algorithm>

#include <meshoptimizer.h>

namespace bounce::gpu {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

// Four joints as 16 bits each in two words, then four weights as float bits in uvec4: 24 bytes would do,
// 32 keep the array a plain uvec4[].
struct Influence {
    glm::uvec4 joints;
    glm::vec4 weights;
};
static_assert(sizeof(Influence) == 32);

template <typename T>
void append(std::vector<T>& out, const std::vector<T>& values, size_t count, const T& fallback) {
    if (values.empty()) {
        out.resize(out.size() + count, fallback);
    } else {
        out.insert(out.end(), values.begin(), values.end());
    }
}

// Triangles in an order that finds most vertices transformed already (Forsyth 2006, "Linear-Speed Vertex
// Cache Optimisation", as meshoptimizer has it): files often hold them in the order they were modelled.
void append_triangles(std::vector<uint32_t>& out, const std::vector<uint32_t>& indices, size_t vertices) {
    const size_t first = out.size();
    out.resize(first + indices.size());
    meshopt_optimizeVertexCache(&out[first], indices.data(), indices.size(), vertices);
}

glm::vec4 matrix_row(const glm::dmat4& matrix, int row) {
    return glm::vec4(glm::dvec4(matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]));
}

}  // namespace

// Streams as they are gathered, in the order of the vertex array.
struct VertexStore::Builder {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents, colors;
    std::vector<glm::vec2> uv0, uv1;
    std::vector<uint32_t> indices;
    std::vector<Influence> influences;
    std::vector<glm::vec4> deltas;
    int weights = 0;
    int matrices = 0;
    bool any_tangents = false, any_uv0 = false, any_uv1 = false, any_colors = false;

    void add_vertices(const scene::Primitive& primitive) {
        const size_t count = primitive.positions.size();
        positions.insert(positions.end(), primitive.positions.begin(), primitive.positions.end());
        append(normals, primitive.normals, count, glm::vec3(0.0F, 1.0F, 0.0F));
        if (any_tangents) append(tangents, primitive.tangents, count, glm::vec4(1.0F, 0.0F, 0.0F, 1.0F));
        if (any_uv0) append(uv0, primitive.uv0, count, glm::vec2(0.0F));
        if (any_uv1) append(uv1, primitive.uv1, count, glm::vec2(0.0F));
        if (any_colors) append(colors, primitive.colors, count, glm::vec4(1.0F));
    }
};

VertexStore::VertexStore(const scene::Scene& scene) {
    Builder build;
    for (const scene::Mesh& mesh : scene.meshes) {
        for (const scene::Primitive& primitive : mesh.primitives) {
            build.any_tangents |= !primitive.tangents.empty();
            build.any_uv0 |= !primitive.uv0.empty();
            build.any_uv1 |= !primitive.uv1.empty();
            build.any_colors |= !primitive.colors.empty();
        }
    }
    for (const scene::Mesh& mesh : scene.meshes) {
        std::vector<PrimitiveRange>& ranges = ranges_.emplace_back();
        for (const scene::Primitive& primitive : mesh.primitives) {
            ranges.push_back({static_cast<int>(build.positions.size()),
                              static_cast<uint32_t>(build.indices.size()),
                              static_cast<uint32_t>(primitive.indices.size())});
            build.add_vertices(primitive);
            append_triangles(build.indices, primitive.indices, primitive.positions.size());
        }
    }
    add_deformed_nodes(scene, build);
    create(build);
}

void VertexStore::add_deformed_nodes(const scene::Scene& scene, Builder& build) {
    for (const scene::Skin& skin : scene.skins) {
        skin_first_matrix_.push_back(build.matrices);
        build.matrices += static_cast<int>(skin.joints.size());
    }
    deformed_.resize(scene.nodes.size());
    contents_.resize(scene.nodes.size());
    node_skins_.assign(scene.nodes.size(), scene::k_none);
    for (const int index : scene.topological_order) {
        const scene::Node& node = scene.nodes[at(index)];
        if (node.mesh == scene::k_none) {
            continue;
        }
        const scene::Mesh& mesh = scene.meshes[at(node.mesh)];
        const bool deforms = std::any_of(mesh.primitives.begin(), mesh.primitives.end(), [&](const auto& p) {
            return !p.targets.empty() || (node.skin != scene::k_none && !p.joints.empty());
        });
        if (!deforms) {
            continue;
        }
        node_skins_[at(index)] = node.skin;
        const int first_weight = build.weights;
        int targets_of_node = 0;
        for (size_t p = 0; p < mesh.primitives.size(); ++p) {
            const scene::Primitive& primitive = mesh.primitives[p];
            PrimitiveRange range = ranges_[at(node.mesh)][p];
            const auto count = static_cast<int>(primitive.positions.size());
            const auto targets = static_cast<int>(primitive.targets.size());
            DeformJob job{};
            job.vertices = {range.base_vertex, static_cast<int>(build.positions.size()), count, 0};
            job.skin = {-1, 0, 0, 0};
            if (node.skin != scene::k_none && !primitive.joints.empty()) {
                job.skin = {static_cast<int>(build.influences.size()), skin_first_matrix_[at(node.skin)], 0,
                            0};
                for (size_t v = 0; v < primitive.joints.size(); ++v) {
                    build.influences.push_back({glm::uvec4(primitive.joints[v]), primitive.weights[v]});
                }
            }
            const bool with_normals = std::any_of(primitive.targets.begin(), primitive.targets.end(),
                                                  [](const auto& t) { return !t.normals.empty(); });
            const int stride = with_normals ? 2 : 1;
            job.morph = {static_cast<int>(build.deltas.size()), targets, first_weight, stride};
            for (const scene::MorphTarget& target : primitive.targets) {
                for (size_t v = 0; v < primitive.positions.size(); ++v) {
                    build.deltas.emplace_back(
                        target.positions.empty() ? glm::vec3(0.0F) : target.positions[v], 0.0F);
                    if (with_normals) {
                        build.deltas.emplace_back(
                            target.normals.empty() ? glm::vec3(0.0F) : target.normals[v], 0.0F);
                    }
                }
            }
            targets_of_node = std::max(targets_of_node, targets);
            range.base_vertex = job.vertices.y;
            build.add_vertices(primitive);
            deformed_[at(index)].push_back(range);
            jobs_.push_back(job);
            job_nodes_.push_back(index);
        }
        build.weights += targets_of_node;
    }
}

void VertexStore::create(Builder& build) {
    const auto stream = [](const char* name, const auto& values) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        return gl::Buffer::of(name, std::span<const T>(values));
    };
    positions_ = stream("positions", build.positions);
    normals_ = stream("normals", build.normals);
    indices_ = stream("indices", build.indices);
    index_count_ = build.indices.size();
    GLuint id = 0;
    glCreateVertexArrays(1, &id);
    vertex_array_ = gl::Object<delete_vertex_array>(id);
    const auto attribute = [&](GLuint location, const gl::Buffer& buffer, int components) {
        glVertexArrayVertexBuffer(id, location, buffer.id(), 0, components * static_cast<int>(sizeof(float)));
        glEnableVertexArrayAttrib(id, location);
        glVertexArrayAttribFormat(id, location, components, GL_FLOAT, GL_FALSE, 0);
        glVertexArrayAttribBinding(id, location, location);
    };
    attribute(ATTRIB_POSITION, positions_, 3);
    attribute(ATTRIB_NORMAL, normals_, 3);
    if (build.any_tangents) {
        tangents_ = stream("tangents", build.tangents);
        attribute(ATTRIB_TANGENT, tangents_, 4);
    }
    if (build.any_uv0) {
        uv0_ = stream("uv0", build.uv0);
        attribute(ATTRIB_UV0, uv0_, 2);
    }
    if (build.any_uv1) {
        uv1_ = stream("uv1", build.uv1);
        attribute(ATTRIB_UV1, uv1_, 2);
    }
    if (build.any_colors) {
        colors_ = stream("colors", build.colors);
        attribute(ATTRIB_COLOR, colors_, 4);
    }
    glVertexArrayElementBuffer(id, indices_.id());
    if (!jobs_.empty()) {
        jobs_buffer_ = gl::Buffer::of("deform jobs", std::span<const DeformJob>(jobs_));
        influences_ = stream("skin influences", build.influences);
        deltas_ = stream("morph deltas", build.deltas);
        skin_matrices_ =
            gl::Buffer("skin matrices", at(build.matrices) * 3 * sizeof(glm::vec4), GL_DYNAMIC_STORAGE_BIT);
        weights_ = gl::Buffer("morph weights", at(build.weights) * sizeof(float), GL_DYNAMIC_STORAGE_BIT);
    }
}

void VertexStore::bind_for_grid() const {
    positions_.bind_storage(SSBO_AVG_POSITIONS);
    indices_.bind_storage(SSBO_AVG_INDICES);
    if (uv0_) uv0_.bind_storage(SSBO_AVG_UV0);
    if (uv1_) uv1_.bind_storage(SSBO_AVG_UV1);
    if (colors_) colors_.bind_storage(SSBO_AVG_COLORS);
}

void VertexStore::set_simplified(const scene::SimplifiedMeshes& meshes) {
    simplified_.clear();
    std::vector<uint32_t> added;
    for (size_t m = 0; m < meshes.size(); ++m) {
        std::vector<PrimitiveRange>& ranges = simplified_.emplace_back();
        for (size_t p = 0; p < meshes[m].size(); ++p) {
            const PrimitiveRange& whole = ranges_[m][p];
            const std::vector<uint32_t>& indices = meshes[m][p].indices;
            ranges.push_back({whole.base_vertex, static_cast<uint32_t>(index_count_ + added.size()),
                              static_cast<uint32_t>(indices.size())});
            const uint32_t last = indices.empty() ? 0 : *std::max_element(indices.begin(), indices.end());
            append_triangles(added, indices, size_t{last} + 1);
        }
    }
    gl::Buffer all("indices", std::max<size_t>((index_count_ + added.size()) * sizeof(uint32_t), 1),
                   GL_DYNAMIC_STORAGE_BIT);
    const auto own = static_cast<GLsizeiptr>(index_count_ * sizeof(uint32_t));
    if (own > 0) {
        glCopyNamedBufferSubData(indices_.id(), all.id(), 0, 0, own);
    }
    if (!added.empty()) {
        all.update(std::span<const uint32_t>(added), index_count_ * sizeof(uint32_t));
    }
    indices_ = std::move(all);
    glVertexArrayElementBuffer(vertex_array_.id(), indices_.id());
}

void VertexStore::set_draw_ids(const gl::Buffer& ids) const {
    const GLuint id = vertex_array_.id();
    glVertexArrayVertexBuffer(id, ATTRIB_DRAW, ids.id(), 0, sizeof(uint32_t));
    glEnableVertexArrayAttrib(id, ATTRIB_DRAW);
    glVertexArrayAttribIFormat(id, ATTRIB_DRAW, 1, GL_UNSIGNED_INT, 0);
    glVertexArrayAttribBinding(id, ATTRIB_DRAW, ATTRIB_DRAW);
    glVertexArrayBindingDivisor(id, ATTRIB_DRAW, 1);
}

void VertexStore::set_pose(const scene::Pose& pose, const RenderSpace& space) {
    if (jobs_.empty()) {
        return;
    }
    const glm::dmat4 render_from_world = space.render_from_world();
    std::vector<glm::vec4> rows;
    std::vector<ContentKey> skins;
    for (const std::vector<glm::dmat4>& skin : pose.skins) {
        const size_t first = rows.size();
        for (const glm::dmat4& world_from_mesh : skin) {
            const glm::dmat4 matrix = render_from_world * world_from_mesh;
            for (int row = 0; row < 3; ++row) {
                rows.push_back(matrix_row(matrix, row));
            }
        }
        skins.push_back(ContentHash().add_all(std::span<const glm::vec4>(rows).subspan(first)).key());
    }
    std::vector<float> weights(weights_.bytes() / sizeof(float), 0.0F);
    for (size_t j = 0; j < jobs_.size(); ++j) {
        const std::vector<float>& source = pose.weights[at(job_nodes_[j])];
        const auto count = std::min(source.size(), at(jobs_[j].morph.y));
        std::copy_n(source.begin(), count, weights.begin() + jobs_[j].morph.z);
    }
    const ContentKey before = content_;
    content_ = ContentHash()
                   .add_all(std::span<const glm::vec4>(rows))
                   .add_all(std::span<const float>(weights))
                   .key();
    if (content_ == before) {
        return;
    }
    skin_matrices_.update(std::span<const glm::vec4>(rows));
    weights_.update(std::span<const float>(weights));
    for (const int node : job_nodes_) {
        ContentHash hash;
        hash.add_all(std::span<const float>(pose.weights[at(node)]));
        if (node_skins_[at(node)] != scene::k_none) {
            hash.add(skins[at(node_skins_[at(node)])]);
        }
        contents_[at(node)] = hash.key();
    }
}

void VertexStore::bind_for_deform() const {
    jobs_buffer_.bind_storage(SSBO_DEFORM_JOBS);
    positions_.bind_storage(SSBO_POSITIONS);
    normals_.bind_storage(SSBO_NORMALS);
    if (tangents_) {
        tangents_.bind_storage(SSBO_TANGENTS);
    }
    influences_.bind_storage(SSBO_SKIN_INFLUENCES);
    skin_matrices_.bind_storage(SSBO_SKIN_MATRICES);
    deltas_.bind_storage(SSBO_MORPH_DELTAS);
    weights_.bind_storage(SSBO_MORPH_WEIGHTS);
}

}  // namespace bounce::gpu
