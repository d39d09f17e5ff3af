// SPDX-License-Identifier: GPL-3.0-or-later
// Encodes one glTF primitive.
#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>

#include "extern_draco.h"
#include "gltf_types.h"

namespace {

constexpr uint32_t k_no_attribute = std::numeric_limits<uint32_t>::max();
constexpr int k_scale_end = 10;  // Draco counts speed, Blender compression: 10 is the end of both scales

template <typename Index>
void read_indices(draco::Mesh& mesh, uint32_t count, const void* data) {
    const auto* bytes = static_cast<const std::byte*>(data);
    mesh.SetNumFaces(count / 3);
    for (uint32_t face = 0; face < count / 3; ++face) {
        draco::Mesh::Face corners;
        for (uint32_t corner = 0; corner < 3; ++corner) {
            Index index;
            std::memcpy(&index, bytes + (size_t{face} * 3 + corner) * sizeof(Index), sizeof(Index));
            if (index >= mesh.num_points())
                throw std::out_of_range("index " + std::to_string(index) + " in a primitive of " +
                                        std::to_string(mesh.num_points()) + " vertices");
            corners[corner] = draco::PointIndex(static_cast<uint32_t>(index));
        }
        mesh.SetFace(draco::FaceIndex(face), corners);
    }
}

// Edgebreaker leaves degenerate triangles out, and what it writes of a mesh that has no others cannot be
// decoded.
bool has_proper_triangle(const draco::Mesh& mesh) {
    const draco::PointAttribute* positions = mesh.GetNamedAttribute(draco::GeometryAttribute::POSITION);
    if (!positions) return false;
    for (uint32_t i = 0; i < mesh.num_faces(); ++i) {
        const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
        const auto a = positions->mapped_index(face[0]);
        const auto b = positions->mapped_index(face[1]);
        const auto c = positions->mapped_index(face[2]);
        if (a != b && b != c && c != a) return true;
    }
    return false;
}

}  // namespace

struct Encoder {
    draco::Mesh mesh;
    bool indices_valid = false;
    int compression_level = 7;
    struct {
        uint32_t position = 14, normal = 10, texcoord = 12, color = 10, generic = 12;
    } bits;
    draco::EncoderBuffer encoded;
    uint32_t encoded_vertices = 0;
    uint32_t encoded_indices = 0;

    draco::Status encode(bool preserve_order) {
        draco::Encoder encoder;
        const int speed = k_scale_end - compression_level;
        encoder.SetSpeedOptions(speed, speed);
        encoder.SetTrackEncodedProperties(true);
        quantize(encoder, draco::GeometryAttribute::POSITION, bits.position);
        quantize(encoder, draco::GeometryAttribute::NORMAL, bits.normal);
        quantize(encoder, draco::GeometryAttribute::TEX_COORD, bits.texcoord);
        quantize(encoder, draco::GeometryAttribute::COLOR, bits.color);
        quantize(encoder, draco::GeometryAttribute::GENERIC, bits.generic);
        encoder.SetEncodingMethod(preserve_order ? draco::MESH_SEQUENTIAL_ENCODING
                                                 : draco::MESH_EDGEBREAKER_ENCODING);
        encoded.Clear();
        draco::Status status = encoder.EncodeMeshToBuffer(mesh, &encoded);
        encoded_vertices = static_cast<uint32_t>(encoder.num_encoded_points());
        encoded_indices = static_cast<uint32_t>(encoder.num_encoded_faces() * 3);
        return status;
    }

  private:
    static void quantize(draco::Encoder& encoder, draco::GeometryAttribute::Type type, uint32_t bit_count) {
        if (bit_count > 0) encoder.SetAttributeQuantization(type, static_cast<int>(bit_count));
    }
};

Encoder* encoderCreate(uint32_t vertex_count) {
    return gltf_types::guarded(static_cast<Encoder*>(nullptr), [&] {
        auto* encoder = new Encoder;
        encoder->mesh.set_num_points(vertex_count);
        return encoder;
    });
}

void encoderRelease(Encoder* encoder) {
    delete encoder;
}

void encoderSetCompressionLevel(Encoder* encoder, uint32_t level) {
    encoder->compression_level = static_cast<int>(std::min<uint32_t>(level, k_scale_end));
}

void encoderSetQuantizationBits(Encoder* encoder, uint32_t position, uint32_t normal, uint32_t texcoord,
                                uint32_t color, uint32_t generic) {
    encoder->bits = {position, normal, texcoord, color, generic};
}

void encoderSetIndices(Encoder* encoder, size_t component_type, uint32_t count, const void* indices) {
    encoder->indices_valid = gltf_types::guarded(false, [&] {
        switch (component_type) {
            case 5121:
                read_indices<uint8_t>(encoder->mesh, count, indices);
                return true;
            case 5123:
                read_indices<uint16_t>(encoder->mesh, count, indices);
                return true;
            case 5125:
                read_indices<uint32_t>(encoder->mesh, count, indices);
                return true;
            default:
                throw std::invalid_argument("indices of component type " + std::to_string(component_type));
        }
    });
}

uint32_t encoderSetAttribute(Encoder* encoder, const char* name, size_t component_type, const char* type,
                             const void* data) {
    return gltf_types::guarded(k_no_attribute, [&] {
        const auto component = gltf_types::component_type(component_type);
        const auto count = gltf_types::component_count(type);
        if (!component || !count)
            throw std::invalid_argument(std::string("attribute ") + name + " of type " + type +
                                        ", component type " + std::to_string(component_type));
        const size_t stride = component->byte_length * static_cast<size_t>(*count);
        const uint32_t vertices = encoder->mesh.num_points();
        draco::GeometryAttribute description;
        description.Init(gltf_types::semantic(name), nullptr, static_cast<uint8_t>(*count),
                         component->draco_type, gltf_types::is_normalized(name, *component),
                         static_cast<int64_t>(stride), 0);
        const int index = encoder->mesh.AddAttribute(description, /*identity_mapping=*/true, vertices);
        draco::PointAttribute* attribute = encoder->mesh.attribute(index);
        attribute->buffer()->Write(0, data, stride * vertices);
        return attribute->unique_id();
    });
}

bool encoderEncode(Encoder* encoder, uint8_t preserve_order) {
    return gltf_types::guarded(false, [&] {
        if (!encoder->indices_valid) throw std::invalid_argument("no valid indices were set");
        if (encoder->mesh.num_faces() == 0) throw std::invalid_argument("a primitive without triangles");
        if (!preserve_order) {
            // Blender splits vertices at seams. Sharing their values again lets the connectivity run across
            // the seam, which is most of what Edgebreaker saves.
            if (!encoder->mesh.DeduplicateAttributeValues())
                throw std::runtime_error("could not share attribute values");
            encoder->mesh.DeduplicatePointIds();
        }
        const bool in_order = preserve_order != 0 || !has_proper_triangle(encoder->mesh);
        // Draco's decoder holds such data for broken.
        if (in_order && encoder->mesh.num_points() > encoder->mesh.num_faces() * 3)
            throw std::invalid_argument("vertices that no triangle uses");
        draco::Status status = encoder->encode(in_order);
        // What Edgebreaker cannot write for another reason can still be written in order.
        if (!status.ok() && !in_order) status = encoder->encode(true);
        if (!status.ok()) throw std::runtime_error(status.error_msg_string());
        return true;
    });
}

uint32_t encoderGetEncodedVertexCount(Encoder* encoder) {
    return encoder->encoded_vertices;
}

uint32_t encoderGetEncodedIndexCount(Encoder* encoder) {
    return encoder->encoded_indices;
}

uint64_t encoderGetByteLength(Encoder* encoder) {
    return encoder->encoded.size();
}

void encoderCopy(Encoder* encoder, void* out) {
    std::memcpy(out, encoder->encoded.data(), encoder->encoded.size());
}
