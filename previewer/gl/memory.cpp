// SPDX-License-Identifier: Apache-2.0
#include "gl/memory.h"

#include <algorithm>
#include <utility>

namespace bounce::gl {
namespace {

// OpenGL objects belong to the thread of their context, so plain numbers will do.
size_t g_alive = 0;
size_t g_peak = 0;

}  // namespace

Allocation::Allocation(size_t bytes) : bytes_(bytes) {
    g_alive += bytes_;
    g_peak = std::max(g_peak, g_alive);
}

Allocation::~Allocation() {
    g_alive -= bytes_;
}

Allocation::Allocation(Allocation&& other) noexcept : bytes_(std::exchange(other.bytes_, 0)) {}

Allocation& Allocation::operator=(Allocation&& other) noexcept {
    if (this != &other) {
        g_alive -= bytes_;
        bytes_ = std::exchange(other.bytes_, 0);
    }
    return *this;
}

size_t allocated_bytes() {
    return g_alive;
}

size_t peak_allocated_bytes() {
    return g_peak;
}

void restart_peak() {
    g_peak = g_alive;
}

}  // namespace bounce::gl
