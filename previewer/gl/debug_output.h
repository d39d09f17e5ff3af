// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace bounce::gl {

// Routes the driver's debug messages: errors are remembered and thrown by throw_on_debug_error,
// performance hints go to the debug log.
void install_debug_output();

// Throws Error(failed) with the first OpenGL error since the last call; `where` names the pass. A lost
// context and memory that has run out are told as such, with what to do.
void throw_on_debug_error(std::string_view where);

// Throws Error(failed) where the driver had no memory for what was just made, `what` in words.
// $BOUNCE_GPU_MEMORY, in bytes, has every allocation beyond it fail as if it were the driver's memory: for
// tests.
void throw_on_failed_allocation(std::string_view what, size_t bytes);

// Throws Error(failed) where the context was lost (a reset of the GPU, which GL_ARB_robustness tells of):
// nothing drawn since can be trusted. With $BOUNCE_LOSE_CONTEXT=N the N-th call finds it lost: for tests.
void throw_on_lost_context();

// Names a range of GL calls for debuggers (RenderDoc, apitrace).
class DebugGroup {
  public:
    explicit DebugGroup(std::string_view name);
    ~DebugGroup();
    DebugGroup(const DebugGroup&) = delete;
    DebugGroup& operator=(const DebugGroup&) = delete;
    DebugGroup(DebugGroup&&) = delete;
    DebugGroup& operator=(DebugGroup&&) = delete;
};

}  // namespace bounce::gl
