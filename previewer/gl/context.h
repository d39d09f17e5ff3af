// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

namespace bounce::gl {

// What the driver can hold at most.
struct DeviceLimits {
    int texture_size = 16384;                             // texels a side
    long long storage_block_bytes = 128LL * 1024 * 1024;  // one buffer that shaders read
    // Storage buffers that a vertex and a tessellation evaluation shader read; OpenGL promises none.
    int vertex_storage_blocks = 8;
    int evaluation_storage_blocks = 8;
};

struct DeviceInfo {
    std::string vendor;
    std::string renderer;
    std::string version;
    // Mesa's llvmpipe or softpipe: work runs inside the call that submits it, so timer queries
    // measure nothing (see pass_timer.h).
    bool software = false;
    DeviceLimits limits;
};

// A current OpenGL 4.5 core context without a window, through EGL's surfaceless platform, falling back to
// EGL's default display. One a process. Throws Error(no_opengl) with a sentence that says what is there
// instead.
class HeadlessContext {
  public:
    HeadlessContext();
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;
    HeadlessContext(HeadlessContext&&) = delete;
    HeadlessContext& operator=(HeadlessContext&&) = delete;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Whether the current context is one of Mesa's software drivers (DeviceInfo::software).
[[nodiscard]] bool is_software_driver();

// Of the current context.
[[nodiscard]] DeviceLimits current_limits();

// What a context must have, whoever made it (EGL here, GLFW in the viewer): OpenGL 4.5 core. Sets the
// conventions that all passes rely on (clip depth 0..1, debug output, seamless cube maps off) and returns
// the device. Throws Error(no_opengl).
DeviceInfo initialise_current_context();

}  // namespace bounce::gl
