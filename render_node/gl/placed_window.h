// SPDX-License-Identifier: Apache-2.0
// The window of a channel: opened on its monitor or at its place, and kept there while monitors
// come and go.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <string>

#include <glm/vec2.hpp>

#include "common/config/rig.h"

struct GLFWmonitor;
struct GLFWwindow;

namespace aquarama::gl {

// Used by the main thread; only framebufferPixels() may be called from others.
class PlacedWindow {
  public:
    // Opens the window, with an OpenGL context that is not current. Throws Error: no such monitor,
    // a framebuffer size or refresh rate that differs from the channel's, no OpenGL 4.5, no left
    // and right buffers where they are requested.
    PlacedWindow(const config::Display& display,
                 const std::string& title,
                 glm::ivec2 sizePixels,
                 bool quadBuffered);
    ~PlacedWindow();
    PlacedWindow(const PlacedWindow&) = delete;
    PlacedWindow& operator=(const PlacedWindow&) = delete;

    // GLFW's window, and the size of its framebuffer in pixels.
    [[nodiscard]] GLFWwindow* handle() const { return window_.get(); }
    [[nodiscard]] glm::ivec2 framebufferPixels() const { return framebuffer_; }
    // GLFW reports another size of the framebuffer.
    void resized(glm::ivec2 framebufferPixels) { framebuffer_ = framebufferPixels; }
    // Place of the pointer in pixels of the framebuffer, from the top left corner.
    [[nodiscard]] glm::vec2 cursor() const;
    // Moves the window back to its monitor when that has come or moved, and off the desktop when it
    // has gone. After GLFW has handled events.
    void keepInPlace();
    // Switches between the rig's place on the desktop and the whole monitor under it.
    void toggleFullscreen();

  private:
    // Deleter of std::unique_ptr<GLFWwindow>.
    struct DestroyWindow {
        void operator()(GLFWwindow* window) const;
    };
    void open(const std::string& title, bool quadBuffered);
    void check();
    // The channel's monitor, or the one under its window. Throws Error where there is none.
    [[nodiscard]] GLFWmonitor* ownMonitor() const;
    // Whether the window fills this monitor, in its mode.
    [[nodiscard]] bool isOn(GLFWmonitor* monitor) const;
    void stayOn(GLFWmonitor* monitor);
    void waitAside();
    void enter(GLFWmonitor* monitor);

    config::Display display_;
    glm::ivec2 size_;
    std::unique_ptr<GLFWwindow, DestroyWindow> window_;
    std::atomic<glm::ivec2> framebuffer_{glm::ivec2(0)};
    bool isAside_ = false;     // its monitor is gone
    bool isTakenOff_ = false;  // by the key f it does not fill its monitor
    int attempts_ = 0;         // to enter its monitor
    std::chrono::steady_clock::time_point lookedAt_;
};

}  // namespace aquarama::gl
