// SPDX-License-Identifier: Apache-2.0
#include "core/log.h"

#include <atomic>
#include <cstdio>
#include <string>

namespace bounce::log {
namespace {

std::atomic<Level> g_threshold{Level::info};

constexpr std::string_view prefix(Level level) {
    switch (level) {
        case Level::debug:
            return "debug: ";
        case Level::info:
            return "";
        case Level::warning:
            return "warning: ";
        case Level::error:
            return "error: ";
    }
    return "";
}

}  // namespace

void set_threshold(Level level) {
    g_threshold = level;
}

void write(Level level, std::string_view message) {
    if (level < g_threshold.load()) {
        return;
    }
    // One write a line, so that lines of several threads do not mix.
    std::string line{prefix(level)};
    line += message;
    line += '\n';
    std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace bounce::log
