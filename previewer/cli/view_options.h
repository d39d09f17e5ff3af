// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "image/view_transform.h"

namespace bounce::cli {

// Options of how scene-linear light becomes a picture for a screen. One that was not given leaves what the
// scene says.
struct ViewOptions {
    std::optional<std::string> display_device;
    std::optional<std::string> view_transform;
    std::optional<std::string> look;
    std::optional<float> exposure_stops;
    std::optional<float> gamma;

    void add_to(CLI::App& command);
    // Whether one was given.
    [[nodiscard]] bool any() const;
    [[nodiscard]] ViewTransform over(ViewTransform scene) const;
    // over(), for names that somebody gave: throws usage_error where one of them is not there, and names
    // those that are. A name of the scene's own that is not there is left to to_display(), which replaces it.
    [[nodiscard]] ViewTransform checked_over(const ViewTransform& scene) const;
};

}  // namespace bounce::cli
