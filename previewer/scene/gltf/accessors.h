// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/gltf/buffers.h"
#include "scene/gltf/source.h"

namespace bounce::scene::gltf {

// Numbers read from accessors: strides, sparse replacements and normalised integers resolved, every
// byte checked to lie inside its buffer view. Throws Refusal.
class Accessors {
  public:
    Accessors(const Source& source, Buffers& buffers) : source_(source), buffers_(buffers) {}

    [[nodiscard]] size_t count(int accessor) const;
    // Numbers an element: 1 for SCALAR, 16 for MAT4.
    [[nodiscard]] int components(int accessor) const;

    // All numbers in order. The accessor must have `components` a element (0: whatever it has).
    [[nodiscard]] std::vector<float> floats(int accessor, int components) const;
    // The same for integers that are not normalised: vertex and joint indices.
    [[nodiscard]] std::vector<uint32_t> integers(int accessor, int components) const;

    // floats() as glm vectors or matrices.
    template <typename Vector>
    [[nodiscard]] std::vector<Vector> vectors(int accessor) const {
        constexpr int components = static_cast<int>(sizeof(Vector) / sizeof(float));
        const std::vector<float> numbers = floats(accessor, components);
        std::vector<Vector> result(numbers.size() / components);
        float* out = reinterpret_cast<float*>(result.data());
        std::copy(numbers.begin(), numbers.end(), out);
        return result;
    }

  private:
    template <typename Out>
    [[nodiscard]] std::vector<Out> read(int accessor, int components) const;

    const Source& source_;
    Buffers& buffers_;
};

}  // namespace bounce::scene::gltf
