// SPDX-License-Identifier: Apache-2.0
#include "gl/memory.h"

#include <atomic>

namespace bounce::gl {
namespace {
std::atomic<size_t> g_bytes{0};
}

void note_allocation(size_t bytes) {
    g_bytes += bytes;
}

size_t allocated_bytes() {
    return g_bytes.load();
}

}  // namespace bounce::gl
