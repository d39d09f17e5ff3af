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
    // Throws usage_error for a limit without --converge (an error is preset auto's target then), and for
    // settings that a mean of passes cannot show.
    void check(const Settings& settings) const;
    // The error that a frame by itself is to reach: without --converge.
    [[nodiscard]] std::optional<double> frame_target() const { return converge ? std::nullopt : relmse; }
    // Ten seconds where nothing was given.
    [[nodiscard]] ConvergeTarget target() const;
};

}  // namespace bounce::cli
