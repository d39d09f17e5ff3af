// SPDX-License-Identifier: Apache-2.0
#pragma once

struct GLFWwindow;

namespace bounce::viewer {

// Dear ImGui on a window: its context, look and drawing. Make it after the window's own callbacks are
// set; it calls them in turn.
class UserInterface {
  public:
    UserInterface(GLFWwindow* window, float content_scale);
    ~UserInterface();
    UserInterface(const UserInterface&) = delete;
    UserInterface& operator=(const UserInterface&) = delete;
    UserInterface(UserInterface&&) = delete;
    UserInterface& operator=(UserInterface&&) = delete;

    // Panels are made between the two.
    void begin();
    void draw();

    // Whether the mouse is over or holds a panel; keys go into a text field. As of begin().
    [[nodiscard]] bool wants_mouse() const;
    [[nodiscard]] bool wants_text() const;
};

}  // namespace bounce::viewer
