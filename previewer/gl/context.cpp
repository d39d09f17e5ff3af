// SPDX-License-Identifier: Apache-2.0
#include "gl/context.h"

// epoxy must come first: it replaces the GL and EGL headers.
#include <epoxy/gl.h>
// then
#include <array>
#include <string_view>

#include <epoxy/egl.h>
#include <fmt/format.h>

#include "core/error.h"
#include "gl/debug_output.h"
#include "gl/shader_cache_room.h"

namespace bounce::gl {
namespace {

Error no_opengl(const std::string& cause) {
    return {
        ExitCode::no_opengl,
        fmt::format("no usable OpenGL 4.5: {}; install a driver, or Mesa's software one (libgl1-mesa-dri)",
                    cause)};
}

bool has_extension(const char* list, std::string_view name) {
    return list != nullptr && std::string_view(list).find(name) != std::string_view::npos;
}

EGLDisplay open_display() {
    const char* client_extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (has_extension(client_extensions, "EGL_MESA_platform_surfaceless")) {
        // The EXT entry point: libepoxy cannot resolve the core one before a display is initialised.
        return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    }
    if (has_extension(client_extensions, "EGL_EXT_platform_device") &&
        has_extension(client_extensions, "EGL_EXT_device_enumeration")) {
        EGLDeviceEXT device = nullptr;
        EGLint count = 0;
        if (eglQueryDevicesEXT(1, &device, &count) == EGL_TRUE && count > 0) {
            return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
        }
    }
    return eglGetDisplay(EGL_DEFAULT_DISPLAY);
}

std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "unknown";  // NOLINT: GL's own type
}

}  // namespace

struct HeadlessContext::Impl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
};

HeadlessContext::HeadlessContext() : impl_(std::make_unique<Impl>()) {
    leave_shader_cache_where_disk_is_full();
    impl_->display = open_display();
    EGLint major = 0;
    EGLint minor = 0;
    if (impl_->display == EGL_NO_DISPLAY || eglInitialize(impl_->display, &major, &minor) != EGL_TRUE) {
        throw no_opengl("EGL finds no display");
    }
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) {
        throw no_opengl("EGL has no desktop OpenGL");
    }
    // A reset of the GPU is to be told of, and not to hang or to draw rubbish (gl::throw_on_lost_context()).
    constexpr std::array<EGLint, 11> context_attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                                           4,
                                                           EGL_CONTEXT_MINOR_VERSION,
                                                           5,
                                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                           EGL_CONTEXT_OPENGL_DEBUG,
                                                           EGL_TRUE,
                                                           EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                                           EGL_LOSE_CONTEXT_ON_RESET,
                                                           EGL_NONE};
    // No config: nothing is drawn to a surface (EGL_KHR_no_config_context).
    impl_->context = eglCreateContext(impl_->display, nullptr, EGL_NO_CONTEXT, context_attributes.data());
    if (impl_->context == EGL_NO_CONTEXT) {
        std::array<EGLint, 11> without = context_attributes;
        without[without.size() - 3] = EGL_NONE;  // a driver that cannot tell
        impl_->context = eglCreateContext(impl_->display, nullptr, EGL_NO_CONTEXT, without.data());
    }
    if (impl_->context == EGL_NO_CONTEXT) {
        throw no_opengl("the driver offers no 4.5 core context");
    }
    if (eglMakeCurrent(impl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, impl_->context) != EGL_TRUE) {
        throw no_opengl("the driver needs a window to draw (no EGL_KHR_surfaceless_context)");
    }
}

HeadlessContext::~HeadlessContext() {
    if (impl_->display != EGL_NO_DISPLAY) {
        eglMakeCurrent(impl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (impl_->context != EGL_NO_CONTEXT) {
            eglDestroyContext(impl_->display, impl_->context);
        }
        eglTerminate(impl_->display);
    }
}

bool is_software_driver() {
    const std::string renderer = gl_string(GL_RENDERER);
    return renderer.find("llvmpipe") != std::string::npos || renderer.find("softpipe") != std::string::npos;
}

DeviceLimits current_limits() {
    DeviceLimits limits;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limits.texture_size);
    GLint64 block = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block);
    limits.storage_block_bytes = block;
    glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &limits.vertex_storage_blocks);
    glGetIntegerv(GL_MAX_TESS_EVALUATION_SHADER_STORAGE_BLOCKS, &limits.evaluation_storage_blocks);
    return limits;
}

DeviceInfo initialise_current_context() {
    const int version = epoxy_gl_version();
    if (!epoxy_is_desktop_gl() || version < 45) {
        throw no_opengl(fmt::format("this driver has {}.{}", version / 10, version % 10));
    }
    DeviceInfo device{gl_string(GL_VENDOR), gl_string(GL_RENDERER), gl_string(GL_VERSION),
                      is_software_driver(), current_limits()};
    install_debug_output();
    // Depth 0..1 with 1 at the near plane keeps float precision far away.
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDepthFunc(GL_GREATER);
    glClearDepth(0.0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    return device;
}

}  // namespace bounce::gl
