// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace bounce::gl {

// Routes the driver's debug messages: errors are remembered and thrown by throw_on_debug_error,
// performance hints go to the debug log.
void install_debug_output();

// Throws Error(failed) with the first OpenGL error since the last call; `where` names the pass.
void throw_on_debug_error(std::string_view where);

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
