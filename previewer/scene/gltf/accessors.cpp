// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/accessors.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

namespace bounce::scene::gltf {
namespace {

// A run of equally spaced elements whose bytes are known to be there.
struct Elements {
    std::span<const uint8_t> bytes{};
    size_t stride = 0;
    size_t count = 0;
    int components = 0;
    int component_type = 0;
    bool normalized = false;
};

size_t component_bytes(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            throw refusal("component type {} is not one of glTF's", type);
    }
}

// Checks that count elements from offset on lie inside the view. Everything is far below 2^63: offsets
// and lengths below 2^53, counts below 2^28, strides at most 256.
Elements elements_in(std::span<const uint8_t> view, uint64_t offset, uint64_t view_stride, Elements layout,
                     const std::string& whose) {
    const size_t element = component_bytes(layout.component_type) * static_cast<size_t>(layout.components);
    layout.stride = view_stride == 0 ? element : view_stride;
    if (layout.stride < element) {
        throw refusal("{} has elements of {} bytes in a buffer view with a stride of {}", whose, element,
                      layout.stride);
    }
    if (layout.count == 0) {
        return layout;
    }
    const uint64_t needed = layout.stride * (layout.count - 1) + element;
    if (offset > view.size() || needed > view.size() - offset) {
        throw refusal("{} needs {} bytes from byte {} on, and its buffer view has {}", whose, needed, offset,
                      view.size());
    }
    layout.bytes = view.subspan(offset);
    return layout;
}

// glTF 2.0, 3.6.2.3: c / 255, max(c / 127, -1) and so on.
template <typename Stored, typename Out>
Out converted(Stored value, bool normalized) {
    if constexpr (std::is_integral_v<Stored> && std::is_floating_point_v<Out>) {
        if (normalized) {
            return std::max(static_cast<Out>(value) / static_cast<Out>(std::numeric_limits<Stored>::max()),
                            static_cast<Out>(-1));
        }
    }
    return static_cast<Out>(value);
}

template <typename Stored, typename Out>
void convert_all(const Elements& from, std::vector<Out>& out) {
    const auto components = static_cast<size_t>(from.components);
    for (size_t i = 0; i < from.count; ++i) {
        const uint8_t* element = from.bytes.data() + i * from.stride;
        for (size_t c = 0; c < components; ++c) {
            Stored value{};
            std::memcpy(&value, element + c * sizeof(Stored), sizeof(Stored));
            out[i * components + c] = converted<Stored, Out>(value, from.normalized);
        }
    }
}

template <typename Out>
std::vector<Out> convert(const Elements& from) {
    std::vector<Out> out(from.count * static_cast<size_t>(from.components));
    switch (from.component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            convert_all<int8_t>(from, out);
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            convert_all<uint8_t>(from, out);
            break;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            convert_all<int16_t>(from, out);
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            convert_all<uint16_t>(from, out);
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            convert_all<uint32_t>(from, out);
            break;
        default:
            if constexpr (std::is_floating_point_v<Out>) {
                convert_all<float>(from, out);
            }
            break;
    }
    return out;
}

template <typename Out>
void replace_sparse(const tinygltf::Accessor& accessor, Buffers& buffers, const std::string& whose,
                    const Elements& dense, std::vector<Out>& out) {
    const auto count = static_cast<size_t>(accessor.sparse.count);
    if (count > dense.count) {
        throw refusal("{} replaces {} of its {} elements", whose, count, dense.count);
    }
    Elements layout{.count = count, .components = 1, .component_type = accessor.sparse.indices.componentType};
    if (layout.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        layout.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        layout.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        throw refusal("{} has sparse indices that are not unsigned integers", whose);
    }
    const std::vector<uint32_t> indices = convert<uint32_t>(elements_in(
        buffers.view(accessor.sparse.indices.bufferView),
        static_cast<uint64_t>(accessor.sparse.indices.byteOffset), 0, layout, whose + " (sparse indices)"));
    Elements value_layout = dense;
    value_layout.count = count;
    const std::vector<Out> values =
        convert<Out>(elements_in(buffers.view(accessor.sparse.values.bufferView),
                                 static_cast<uint64_t>(accessor.sparse.values.byteOffset), 0, value_layout,
                                 whose + " (sparse values)"));
    const auto components = static_cast<size_t>(dense.components);
    for (size_t i = 0; i < count; ++i) {
        if (indices[i] >= dense.count) {
            throw refusal("{} replaces element {} of {}", whose, indices[i], dense.count);
        }
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * components), components,
                    out.begin() + static_cast<std::ptrdiff_t>(indices[i] * components));
    }
}

}  // namespace

size_t Accessors::count(int accessor) const {
    return source_.model.accessors[static_cast<size_t>(accessor)].count;
}

int Accessors::components(int accessor) const {
    return tinygltf::GetNumComponentsInType(
        static_cast<uint32_t>(source_.model.accessors[static_cast<size_t>(accessor)].type));
}

template <typename Out>
std::vector<Out> Accessors::read(int index, int expected) const {
    const tinygltf::Accessor& accessor = source_.model.accessors[static_cast<size_t>(index)];
    const std::string whose = fmt::format("accessor {}", index);
    Elements layout{.count = accessor.count,
                    .components = components(index),
                    .component_type = accessor.componentType,
                    .normalized = accessor.normalized};
    if (expected != 0 && layout.components != expected) {
        throw refusal("{} has {} numbers an element where {} belong", whose, layout.components, expected);
    }
    (void)component_bytes(layout.component_type);
    // Columns of matrices of small integers are padded to four bytes; nothing that is read here has any.
    const bool is_matrix = accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3 ||
                           accessor.type == TINYGLTF_TYPE_MAT4;
    if (is_matrix && layout.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT) {
        throw refusal("{} holds matrices that are not floats", whose);
    }
    if (std::is_integral_v<Out> && layout.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT) {
        throw refusal("{} holds floats where integers belong", whose);
    }
    std::vector<Out> out;
    if (accessor.bufferView >= 0) {
        const auto stride = source_.model.bufferViews[static_cast<size_t>(accessor.bufferView)].byteStride;
        layout = elements_in(buffers_.view(accessor.bufferView), accessor.byteOffset, stride, layout, whose);
        out = convert<Out>(layout);
    } else {
        if (accessor.count > k_max_zero_elements) {
            throw refusal("{} has {} elements and no buffer view, more than the {} allowed", whose,
                          accessor.count, k_max_zero_elements);
        }
        out.resize(layout.count * static_cast<size_t>(layout.components));
    }
    if (accessor.sparse.isSparse) {
        replace_sparse(accessor, buffers_, whose, layout, out);
    }
    return out;
}

std::vector<float> Accessors::floats(int accessor, int components) const {
    return read<float>(accessor, components);
}

std::vector<uint32_t> Accessors::integers(int accessor, int components) const {
    return read<uint32_t>(accessor, components);
}

}  // namespace bounce::scene::gltf
