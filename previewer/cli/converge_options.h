// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <CLI/CLI.hpp>

#include "renderer/converge.h"
#include "renderer/settings.h"

namespace bounce::cli {

// Options of pictures that grow better for as long as they are given (renderer/converge.h).
struct ConvergeOptions {
    bool converge = false;
    std::optional<double> seconds;
    std::optional<double> relmse;
    std::optional<int> passes;

    void add_to(CLI::App& command);
    // Throws usage_error for a target without --converge, and for settings that a mean of passes cannot show.
    void check(const Settings& settings) const;
    // Ten seconds where nothing was given.
    [[nodiscard]] ConvergeTarget target() const;
};

}  // namespace bounce::cli
