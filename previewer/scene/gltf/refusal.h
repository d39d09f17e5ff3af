// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace bounce::scene::gltf {

// Why a file is refused: a clause without the file's name, which load_gltf puts in front.
class Refusal : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

template <typename... Args>
[[nodiscard]] Refusal refusal(fmt::format_string<Args...> format, Args&&... args) {
    return Refusal(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace bounce::scene::gltf
