// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "viewer/key_bindings.h"

struct GLFWwindow;

namespace bounce::viewer {

// What a drag with the mouse does; chosen when the button goes down.
enum class Drag { orbit, pan, zoom };

// What the user did since it was last asked for. Motion adds up, so that a slow frame queues nothing.
struct Input {
    std::vector<Command> commands;
    std::optional<Drag> drag;  // a button is or was down
    bool drag_began = false;
    glm::dvec2 moved{0.0};  // while it was, in heights of the window
    double scrolled = 0.0;
    bool any = false;  // something happened that the window may have to answer by drawing
};

// A window with a current OpenGL 4.5 core context. One a process.
class Window {
  public:
    // Throws Error(no_opengl) where there is no display, or no OpenGL 4.5 on it.
    Window(const std::string& title, glm::ivec2 size);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    Window(Window&&) = delete;
    Window& operator=(Window&&) = delete;

    // Takes events without waiting.
    void poll();
    // Waits for an event, at most so long.
    void wait(double seconds);
    [[nodiscard]] Input take_input();
    void swap();

    void close();
    [[nodiscard]] bool should_close() const;
    void set_title(const std::string& title);
    [[nodiscard]] glm::ivec2 framebuffer_size() const;
    [[nodiscard]] float content_scale() const;
    [[nodiscard]] GLFWwindow* handle() const { return window_; }

  private:
    struct Library;  // GLFW itself, ended after the window
    struct Callbacks;

    std::unique_ptr<Library> library_;
    GLFWwindow* window_ = nullptr;
    Input input_;
    int drag_button_ = -1;
    glm::dvec2 cursor_{0.0};
};

}  // namespace bounce::viewer
