// SPDX-License-Identifier: Apache-2.0
//
// Drop-down lists of the panels.
#pragma once

#include <array>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

namespace bounce::viewer {

// One of some sizes, 0 by a name of its own; true where another was chosen.
template <size_t N>
bool choose_size(const char* label, const std::array<int, N>& sizes, int& value,
                 const char* zero = "automatic") {
    const auto name = [&](int size) { return size == 0 ? std::string(zero) : fmt::format("{}", size); };
    bool changed = false;
    if (ImGui::BeginCombo(label, name(value).c_str())) {
        for (const int size : sizes) {
            if (ImGui::Selectable(name(size).c_str(), size == value) && size != value) {
                value = size;
                changed = true;
            }
        }
        ImGui::EndCombo();
    }
    return changed;
}

// One of an enumeration's values, which count from 0 in the order of the names.
template <typename T, size_t N>
bool choose(const char* label, const std::array<const char*, N>& names, T& value) {
    int index = static_cast<int>(value);
    if (!ImGui::Combo(label, &index, names.data(), static_cast<int>(N))) {
        return false;
    }
    value = static_cast<T>(index);
    return true;
}

}  // namespace bounce::viewer
