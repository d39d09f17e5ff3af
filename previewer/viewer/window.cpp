// SPDX-License-Identifier: Apache-2.0
#include "viewer/window.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "core/error.h"
#include "gl/shader_cache_room.h"

namespace bounce::viewer {
namespace {

Error no_window(std::string_view why) {
    return {ExitCode::no_opengl,
            fmt::format("cannot open a window with OpenGL 4.5: {}; bounce render needs none", why)};
}

// GLFW's description of its last error, on one line.
std::string last_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    std::string line = text != nullptr ? text : "GLFW does not say why";
    std::replace(line.begin(), line.end(), '\n', ' ');
    return line;
}

// At most the part of the screen that is free of bars, less a little for the window's own frame.
glm::ivec2 fit_to_screen(glm::ivec2 size) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (monitor == nullptr) {
        return size;
    }
    constexpr double part = 0.95;
    glm::ivec2 corner;
    glm::ivec2 room;
    glfwGetMonitorWorkarea(monitor, &corner.x, &corner.y, &room.x, &room.y);
    const glm::dvec2 ratio = glm::dvec2(room) * part / glm::dvec2(size);
    const double scale = std::min({ratio.x, ratio.y, 1.0});
    return glm::max(glm::ivec2(glm::dvec2(size) * (scale > 0.0 ? scale : 1.0)), glm::ivec2(1));
}

}  // namespace

struct Window::Library {
    Library() {
        gl::leave_shader_cache_where_disk_is_full();
        if (glfwInit() != GLFW_TRUE) {
            throw no_window(last_error());
        }
    }
    ~Library() { glfwTerminate(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    Library(Library&&) = delete;
    Library& operator=(Library&&) = delete;
};

struct Window::Callbacks {
    static Window& window_of(GLFWwindow* handle) {
        return *static_cast<Window*>(glfwGetWindowUserPointer(handle));
    }

    static void key(GLFWwindow* handle, int key, int /*scancode*/, int action, int modifiers) {
        Window& window = window_of(handle);
        window.input_.any = true;
        if (action == GLFW_RELEASE) {
            return;
        }
        if (const auto command = command_of(SpecialKey{key, (modifiers & GLFW_MOD_SHIFT) != 0})) {
            window.input_.commands.push_back(*command);
        }
    }

    static void character(GLFWwindow* handle, unsigned int codepoint) {
        Window& window = window_of(handle);
        window.input_.any = true;
        if (const auto command = command_of(static_cast<char32_t>(codepoint))) {
            window.input_.commands.push_back(*command);
        }
    }

    static void button(GLFWwindow* handle, int button, int action, int modifiers) {
        Window& window = window_of(handle);
        window.input_.any = true;
        const bool drags = button == GLFW_MOUSE_BUTTON_LEFT || button == GLFW_MOUSE_BUTTON_MIDDLE;
        if (action == GLFW_PRESS && drags && window.drag_button_ < 0) {
            window.drag_button_ = button;
            window.input_.drag_began = true;
            window.input_.drag = (modifiers & GLFW_MOD_SHIFT) != 0     ? Drag::pan
                                 : (modifiers & GLFW_MOD_CONTROL) != 0 ? Drag::zoom
                                                                       : Drag::orbit;
        } else if (action == GLFW_RELEASE && button == window.drag_button_) {
            window.drag_button_ = -1;
        }
    }

    static void cursor(GLFWwindow* handle, double x, double y) {
        Window& window = window_of(handle);
        window.input_.any = true;
        const glm::dvec2 position(x, y);
        if (window.drag_button_ >= 0) {
            glm::ivec2 size;
            glfwGetWindowSize(handle, &size.x, &size.y);
            window.input_.moved += (position - window.cursor_) / static_cast<double>(std::max(size.y, 1));
        }
        window.cursor_ = position;
    }

    static void scroll(GLFWwindow* handle, double /*x*/, double y) {
        Window& window = window_of(handle);
        window.input_.any = true;
        window.input_.scrolled += y;
    }

    static void resized(GLFWwindow* handle, int /*width*/, int /*height*/) {
        window_of(handle).input_.any = true;
    }
    static void exposed(GLFWwindow* handle) { window_of(handle).input_.any = true; }
    static void focus(GLFWwindow* handle, int /*focused*/) { window_of(handle).input_.any = true; }
};

Window::Window(const std::string& title, glm::ivec2 size) : library_(std::make_unique<Library>()) {
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    // Passes have depth buffers of their own.
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    const glm::ivec2 fitted = fit_to_screen(size);
    window_ = glfwCreateWindow(fitted.x, fitted.y, title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        throw no_window(last_error());
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(window_, this);
    glfwGetCursorPos(window_, &cursor_.x, &cursor_.y);
    glfwSetKeyCallback(window_, Callbacks::key);
    glfwSetCharCallback(window_, Callbacks::character);
    glfwSetMouseButtonCallback(window_, Callbacks::button);
    glfwSetCursorPosCallback(window_, Callbacks::cursor);
    glfwSetScrollCallback(window_, Callbacks::scroll);
    glfwSetFramebufferSizeCallback(window_, Callbacks::resized);
    glfwSetWindowRefreshCallback(window_, Callbacks::exposed);
    glfwSetWindowFocusCallback(window_, Callbacks::focus);
}

Window::~Window() {
    glfwDestroyWindow(window_);
}

void Window::poll() {
    glfwPollEvents();
}

void Window::wait(double seconds) {
    glfwWaitEventsTimeout(seconds);
}

Input Window::take_input() {
    Input taken = std::exchange(input_, Input{});
    if (drag_button_ >= 0) {
        input_.drag = taken.drag;  // goes on
    }
    return taken;
}

void Window::swap() {
    glfwSwapBuffers(window_);
}

void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

bool Window::should_close() const {
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

glm::ivec2 Window::framebuffer_size() const {
    glm::ivec2 size;
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
}

float Window::content_scale() const {
    glm::vec2 scale(1.0F);
    glfwGetWindowContentScale(window_, &scale.x, &scale.y);
    return std::max({scale.x, scale.y, 1.0F});
}

}  // namespace bounce::viewer
