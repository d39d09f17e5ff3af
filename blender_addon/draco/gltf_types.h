// SPDX-License-Identifier: GPL-3.0-or-later
// glTF's words and numbers for accessor types, in Draco's terms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <string_view>

#include <draco/attributes/geometry_attribute.h>
#include <draco/core/draco_types.h>

namespace gltf_types {

struct ComponentType {
    draco::DataType draco_type;
    size_t byte_length;
    bool is_float;
};

// Empty for a number that is no glTF component type.
std::optional<ComponentType> component_type(size_t gltf_number);

// 1 for "SCALAR" … 4 for "VEC4"; empty for matrices, which no vertex attribute has.
std::optional<int8_t> component_count(std::string_view gltf_type);

// What a glTF attribute name means to Draco, which chooses prediction and quantisation by it.
draco::GeometryAttribute::Type semantic(std::string_view attribute_name);

// Integer colours and weights stand for fractions in glTF; joints are plain numbers.
bool is_normalized(std::string_view attribute_name, const ComponentType& type);

// One sentence on stderr: ctypes callers see only `false`.
void report(const char* what);

// No exception may cross into the C caller; it becomes a sentence and `on_error`.
template <typename Result, typename Function>
Result guarded(Result on_error, Function&& function) noexcept {
    try {
        return function();
    } catch (const std::exception& error) {
        report(error.what());
        return on_error;
    }
}

}  // namespace gltf_types
