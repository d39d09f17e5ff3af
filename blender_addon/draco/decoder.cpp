// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes one glTF primitive into arrays of the component types that its accessors ask for.
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include "extern_draco.h"
#include "gltf_types.h"

struct Decoder {
    std::unique_ptr<draco::Mesh> mesh;
    std::vector<std::byte> indices;
    std::map<uint32_t, std::vector<std::byte>> attributes;
};

namespace {

const draco::PointAttribute& find_attribute(const Decoder& decoder, uint32_t id) {
    const draco::PointAttribute* attribute =
        decoder.mesh ? decoder.mesh->GetAttributeByUniqueId(id) : nullptr;
    if (!attribute) throw std::out_of_range("no attribute of id " + std::to_string(id));
    return *attribute;
}

template <typename Component>
std::vector<std::byte> read_attribute(const Decoder& decoder, const draco::PointAttribute& attribute,
                                      int8_t count) {
    const uint32_t vertices = decoder.mesh->num_points();
    const size_t stride = sizeof(Component) * static_cast<size_t>(count);
    std::vector<std::byte> out(stride * vertices);
    std::vector<Component> value(static_cast<size_t>(count));
    for (uint32_t vertex = 0; vertex < vertices; ++vertex) {
        const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(vertex));
        if (!attribute.ConvertValue<Component>(index, count, value.data()))
            throw std::runtime_error("a value does not fit the accessor's component type");
        std::memcpy(out.data() + vertex * stride, value.data(), stride);
    }
    return out;
}

template <typename Index>
std::vector<std::byte> read_indices(const draco::Mesh& mesh) {
    if (mesh.num_points() > 0 && mesh.num_points() - 1 > std::numeric_limits<Index>::max())
        throw std::out_of_range("vertex numbers do not fit the accessor's component type");
    std::vector<std::byte> out(size_t{mesh.num_faces()} * 3 * sizeof(Index));
    std::byte* at = out.data();
    for (uint32_t face = 0; face < mesh.num_faces(); ++face) {
        for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(face))) {
            const auto index = static_cast<Index>(point.value());
            std::memcpy(at, &index, sizeof index);
            at += sizeof index;
        }
    }
    return out;
}

}  // namespace

Decoder* decoderCreate() {
    return gltf_types::guarded(static_cast<Decoder*>(nullptr), [] { return new Decoder; });
}

void decoderRelease(Decoder* decoder) {
    delete decoder;
}

bool decoderDecode(Decoder* decoder, const void* data, size_t byte_length) {
    return gltf_types::guarded(false, [&] {
        draco::DecoderBuffer buffer;
        buffer.Init(static_cast<const char*>(data), byte_length);
        draco::Decoder draco_decoder;
        auto result = draco_decoder.DecodeMeshFromBuffer(&buffer);
        if (!result.ok()) throw std::runtime_error(result.status().error_msg_string());
        decoder->mesh = std::move(result).value();
        decoder->indices.clear();
        decoder->attributes.clear();
        return true;
    });
}

uint32_t decoderGetVertexCount(Decoder* decoder) {
    return decoder->mesh ? decoder->mesh->num_points() : 0;
}

uint32_t decoderGetIndexCount(Decoder* decoder) {
    return decoder->mesh ? decoder->mesh->num_faces() * 3 : 0;
}

bool decoderAttributeIsNormalized(Decoder* decoder, uint32_t id) {
    return gltf_types::guarded(false, [&] { return find_attribute(*decoder, id).normalized(); });
}

bool decoderReadAttribute(Decoder* decoder, uint32_t id, size_t component_type, const char* type) {
    return gltf_types::guarded(false, [&] {
        const draco::PointAttribute& attribute = find_attribute(*decoder, id);
        const auto count = gltf_types::component_count(type);
        if (!count) throw std::invalid_argument(std::string("attribute of type ") + type);
        auto& out = decoder->attributes[id];
        switch (component_type) {
            case 5120:
                out = read_attribute<int8_t>(*decoder, attribute, *count);
                return true;
            case 5121:
                out = read_attribute<uint8_t>(*decoder, attribute, *count);
                return true;
            case 5122:
                out = read_attribute<int16_t>(*decoder, attribute, *count);
                return true;
            case 5123:
                out = read_attribute<uint16_t>(*decoder, attribute, *count);
                return true;
            case 5125:
                out = read_attribute<uint32_t>(*decoder, attribute, *count);
                return true;
            case 5126:
                out = read_attribute<float>(*decoder, attribute, *count);
                return true;
            default:
                throw std::invalid_argument("attribute of component type " + std::to_string(component_type));
        }
    });
}

size_t decoderGetAttributeByteLength(Decoder* decoder, uint32_t id) {
    const auto found = decoder->attributes.find(id);
    return found == decoder->attributes.end() ? 0 : found->second.size();
}

void decoderCopyAttribute(Decoder* decoder, uint32_t id, void* out) {
    const auto found = decoder->attributes.find(id);
    if (found != decoder->attributes.end()) std::memcpy(out, found->second.data(), found->second.size());
}

bool decoderReadIndices(Decoder* decoder, size_t component_type) {
    return gltf_types::guarded(false, [&] {
        if (!decoder->mesh) throw std::logic_error("nothing was decoded");
        switch (component_type) {
            case 5121:
                decoder->indices = read_indices<uint8_t>(*decoder->mesh);
                return true;
            case 5123:
                decoder->indices = read_indices<uint16_t>(*decoder->mesh);
                return true;
            case 5125:
                decoder->indices = read_indices<uint32_t>(*decoder->mesh);
                return true;
            default:
                throw std::invalid_argument("indices of component type " + std::to_string(component_type));
        }
    });
}

size_t decoderGetIndicesByteLength(Decoder* decoder) {
    return decoder->indices.size();
}

void decoderCopyIndices(Decoder* decoder, void* out) {
    std::memcpy(out, decoder->indices.data(), decoder->indices.size());
}
