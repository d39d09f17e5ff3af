// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/draco_decoder.h"

#include <new>

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include "scene/gltf/refusal.h"
#include "scene/limits.h"

namespace bounce::scene::gltf {
namespace {

template <typename Out>
void values(const draco::PointAttribute& attribute, draco::PointIndex point, int components, Out* out,
            const std::string& whose) {
    const draco::AttributeValueIndex index = attribute.mapped_index(point);
    if (index.value() >= attribute.size() ||
        !attribute.ConvertValue<Out>(index, static_cast<int8_t>(components), out)) {
        throw refusal("{} holds Draco data that refers to missing values", whose);
    }
}

}  // namespace

DracoMesh::DracoMesh(std::span<const uint8_t> bytes, const std::string& whose) : whose_(whose) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    try {
        auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
        if (!decoded.ok()) {
            throw refusal("the Draco data of {} cannot be decoded: {}", whose, decoded.status().error_msg());
        }
        mesh_ = std::move(decoded).value();
    } catch (const std::bad_alloc&) {
        throw refusal("the Draco data of {} asks for more memory than there is", whose);
    }
    if (mesh_->num_points() > k_max_total_vertices || mesh_->num_faces() > k_max_total_indices / 3) {
        throw refusal("the Draco data of {} has {} vertices and {} triangles, more than allowed", whose,
                      mesh_->num_points(), mesh_->num_faces());
    }
}

DracoMesh::~DracoMesh() = default;
DracoMesh::DracoMesh(DracoMesh&&) noexcept = default;
DracoMesh& DracoMesh::operator=(DracoMesh&&) noexcept = default;

size_t DracoMesh::vertex_count() const {
    return mesh_->num_points();
}

std::vector<uint32_t> DracoMesh::indices() const {
    std::vector<uint32_t> result;
    result.reserve(size_t{mesh_->num_faces()} * 3);
    for (draco::FaceIndex face(0); face < mesh_->num_faces(); ++face) {
        for (const draco::PointIndex& point : mesh_->face(face)) {
            result.push_back(point.value());
        }
    }
    return result;
}

const draco::PointAttribute& DracoMesh::attribute(uint32_t id, int components) const {
    const draco::PointAttribute* found = mesh_->GetAttributeByUniqueId(id);
    if (found == nullptr) {
        throw refusal("{} names Draco attribute {}, which its data does not have", whose_, id);
    }
    if (found->num_components() != components) {
        throw refusal("Draco attribute {} of {} has {} numbers a vertex where {} belong", id, whose_,
                      found->num_components(), components);
    }
    return *found;
}

std::vector<float> DracoMesh::floats(uint32_t id, int components, float scale) const {
    const draco::PointAttribute& from = attribute(id, components);
    const bool is_float = from.data_type() == draco::DT_FLOAT32 || from.data_type() == draco::DT_FLOAT64;
    const auto width = static_cast<size_t>(components);
    std::vector<float> result(vertex_count() * width);
    std::vector<int64_t> integer(width);
    for (size_t i = 0; i < vertex_count(); ++i) {
        const draco::PointIndex point(static_cast<uint32_t>(i));
        float* out = &result[i * width];
        if (is_float) {
            values(from, point, components, out, whose_);
            continue;
        }
        values(from, point, components, integer.data(), whose_);
        for (size_t c = 0; c < width; ++c) {
            // As for plain accessors: -128 is -1 as well.
            out[c] = scale == 1.0F ? static_cast<float>(integer[c])
                                   : std::max(static_cast<float>(integer[c]) * scale, -1.0F);
        }
    }
    return result;
}

std::vector<uint32_t> DracoMesh::integers(uint32_t id, int components) const {
    const draco::PointAttribute& from = attribute(id, components);
    const auto width = static_cast<size_t>(components);
    std::vector<uint32_t> result(vertex_count() * width);
    for (size_t i = 0; i < vertex_count(); ++i) {
        values(from, draco::PointIndex(static_cast<uint32_t>(i)), components, &result[i * width], whose_);
    }
    return result;
}

}  // namespace bounce::scene::gltf
