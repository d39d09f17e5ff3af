// SPDX-License-Identifier: Apache-2.0
#include "gl/debug_output.h"

#include <algorithm>
#include <cstdlib>
#include <string>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"
#include "gl/memory.h"

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

bool is_out_of_memory() {
    return g_first_error.find("GL_OUT_OF_MEMORY") != std::string::npos;
}

void forget_errors() {
    g_first_error.clear();
    // A lost context never has no error.
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
    }
}

[[noreturn]] void throw_pending(GLenum code, const std::string& what) {
    forget_errors();
    if (code == GL_CONTEXT_LOST) {
        throw Error(
            ExitCode::failed,
            "the driver has reset the GPU, and with it what was being drawn; frames written before are "
            "whole: start again behind them, with smaller settings where it happens again");
    }
    throw Error(
        ExitCode::failed,
        fmt::format("the GPU has no memory left for {}; frames written before are whole: lower --size, "
                    "--vpls, --ism-size, --rsm-size or --shadow-size",
                    what));
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
    const GLenum code = glGetError();
    if (g_first_error.empty() && code == GL_NO_ERROR) {
        return;
    }
    if (code == GL_CONTEXT_LOST || code == GL_OUT_OF_MEMORY || is_out_of_memory()) {
        throw_pending(code, fmt::format("what {} needs", where));
    }
    const std::string message =
        fmt::format("OpenGL refused a call in {}: {}", where,
                    g_first_error.empty() ? fmt::format("error 0x{:04x}", code) : g_first_error);
    forget_errors();
    throw Error(ExitCode::failed, message);
}

void throw_on_failed_allocation(std::string_view what, size_t bytes) {
    const std::string sized = fmt::format("{} of {:.1f} MiB", what, static_cast<double>(bytes) / 1048576.0);
    if (const char* limit = std::getenv("BOUNCE_GPU_MEMORY");
        limit != nullptr && static_cast<double>(allocated_bytes() + bytes) > std::strtod(limit, nullptr)) {
        throw_pending(GL_OUT_OF_MEMORY, sized);
    }
    if (const GLenum code = glGetError();
        code == GL_OUT_OF_MEMORY || code == GL_CONTEXT_LOST || is_out_of_memory()) {
        throw_pending(code, sized);
    } else if (code != GL_NO_ERROR && g_first_error.empty()) {
        g_first_error = fmt::format("error 0x{:04x}", code);  // for throw_on_debug_error()
    }
}

void throw_on_lost_context() {
    static const char* const lost_at = std::getenv("BOUNCE_LOSE_CONTEXT");
    static long calls = 0;
    const bool simulated = lost_at != nullptr && ++calls == std::strtol(lost_at, nullptr, 10);
    if (simulated || glGetGraphicsResetStatus() != GL_NO_ERROR) {
        throw_pending(GL_CONTEXT_LOST, {});
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
