// SPDX-License-Identifier: Apache-2.0
// A window on each monitor of this machine, for what is shown while no rig says which is whose.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "render_node/gl/glfw_library.h"

struct GLFWmonitor;
struct GLFWwindow;

namespace aquarama::gl {

// Of the main thread; only one window context may exist at a time, and these are it.
class MonitorWindows {
  public:
    // On the monitor at this connector alone; empty: on all. Where there is none, it is waited for.
    // Throws Error where no window can be opened.
    MonitorWindows(std::string title, std::string connector);
    // Whether there is a monitor with a window.
    [[nodiscard]] bool isSeen() const { return !windows_.empty(); }
    // Handles events for so long. True: somebody has pressed q or Escape, or has closed a window.
    [[nodiscard]] bool pumpEvents(std::chrono::milliseconds atMost);
    // Draws in each window, whose context is current for `paint`, and shows it. Monitors that have
    // come since get one too.
    void draw(const std::function<void(glm::ivec2 sizePixels)>& paint);

  private:
    // Deleter of std::unique_ptr<GLFWwindow>.
    struct DestroyWindow {
        void operator()(GLFWwindow* window) const;
    };
    void open();
    // Those that are to have windows.
    [[nodiscard]] std::vector<GLFWmonitor*> monitorsNow() const;

    GlfwLibrary library_;
    std::string title_, connector_;
    std::vector<GLFWmonitor*> monitors_;  // that have windows
    std::vector<std::unique_ptr<GLFWwindow, DestroyWindow>> windows_;
};

}  // namespace aquarama::gl
