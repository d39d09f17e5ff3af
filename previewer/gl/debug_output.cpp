// SPDX-License-Identifier: Apache-2.0
#include "gl/debug_output.h"

#include <algorithm>
#include <string>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"

namespace bounce::gl {
namespace {

// Output is synchronous, so the callback runs on the thread that made the call.
thread_local std::string g_first_error;

void GLAPIENTRY on_message(GLenum source, GLenum type, GLuint /*id*/, GLenum severity, GLsizei length,
                           const GLchar* text, const void* /*user*/) {
    // What a compiler says is in its log, which Program throws; left here it would be blamed on the next
    // pass.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) {
        return;
    }
    const std::string_view message(text, static_cast<size_t>(length));
    if (type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR) {
        if (g_first_error.empty()) {
            g_first_error = message;
        }
        return;
    }
    if (severity != GL_DEBUG_SEVERITY_NOTIFICATION) {
        log::debug("OpenGL: {}", message);
    }
}

}  // namespace

void install_debug_output() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_NOTIFICATION, 0, nullptr, GL_FALSE);
    glDebugMessageCallback(on_message, nullptr);
}

void throw_on_debug_error(std::string_view where) {
    // A context without the debug bit may stay silent: ask the old way as well.
    if (g_first_error.empty()) {
        if (const GLenum code = glGetError(); code != GL_NO_ERROR) {
            g_first_error = fmt::format("error 0x{:04x}", code);
        }
    }
    if (!g_first_error.empty()) {
        const std::string message = fmt::format("OpenGL refused a call in {}: {}", where, g_first_error);
        g_first_error.clear();
        while (glGetError() != GL_NO_ERROR) {
        }
        throw Error(ExitCode::failed, message);
    }
}

DebugGroup::DebugGroup(std::string_view name) {
    constexpr size_t longest = 255;  // drivers take 256 at least
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(std::min(name.size(), longest)),
                     name.data());
}

DebugGroup::~DebugGroup() {
    glPopDebugGroup();
}

}  // namespace bounce::gl
