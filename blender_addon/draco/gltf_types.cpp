// SPDX-License-Identifier: GPL-3.0-or-later
#include "gltf_types.h"

#include <cstdio>

namespace gltf_types {

std::optional<ComponentType> component_type(size_t gltf_number) {
    switch (gltf_number) {
        case 5120:
            return ComponentType{draco::DT_INT8, 1, false};
        case 5121:
            return ComponentType{draco::DT_UINT8, 1, false};
        case 5122:
            return ComponentType{draco::DT_INT16, 2, false};
        case 5123:
            return ComponentType{draco::DT_UINT16, 2, false};
        case 5125:
            return ComponentType{draco::DT_UINT32, 4, false};
        case 5126:
            return ComponentType{draco::DT_FLOAT32, 4, true};
        default:
            return std::nullopt;
    }
}

std::optional<int8_t> component_count(std::string_view gltf_type) {
    if (gltf_type == "SCALAR") return int8_t{1};
    if (gltf_type == "VEC2") return int8_t{2};
    if (gltf_type == "VEC3") return int8_t{3};
    if (gltf_type == "VEC4") return int8_t{4};
    return std::nullopt;
}

draco::GeometryAttribute::Type semantic(std::string_view attribute_name) {
    if (attribute_name == "POSITION") return draco::GeometryAttribute::POSITION;
    if (attribute_name == "NORMAL") return draco::GeometryAttribute::NORMAL;
    if (attribute_name.starts_with("TEXCOORD_")) return draco::GeometryAttribute::TEX_COORD;
    if (attribute_name.starts_with("COLOR_")) return draco::GeometryAttribute::COLOR;
    return draco::GeometryAttribute::GENERIC;
}

bool is_normalized(std::string_view attribute_name, const ComponentType& type) {
    return !type.is_float &&
           (attribute_name.starts_with("COLOR_") || attribute_name.starts_with("WEIGHTS_") ||
            attribute_name.starts_with("TEXCOORD_"));
}

void report(const char* what) {
    std::fprintf(stderr, "extern_draco: %s\n", what);
}

}  // namespace gltf_types
