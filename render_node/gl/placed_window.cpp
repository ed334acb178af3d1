// SPDX-License-Identifier: Apache-2.0
#include "render_node/gl/placed_window.h"

#include <array>
#include <cassert>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <glm/common.hpp>

#include "common/base/log.h"
#include "render_node/gl/glfw_library.h"
#include "render_node/gl/monitors.h"

namespace aquarama::gl {

PlacedWindow::PlacedWindow(const config::Display& display,
                           const std::string& title,
                           glm::ivec2 sizePixels,
                           bool quadBuffered)
    : display_{display}, size_{sizePixels} {
    assert(size_.x > 0);
    assert(size_.y > 0);
    open(title, quadBuffered);
    check();
}

PlacedWindow::~PlacedWindow() = default;

void PlacedWindow::DestroyWindow::operator()(GLFWwindow* window) const {
    glfwDestroyWindow(window);
}

// The hints must be set before the window is created. The window stays hidden until it is at its
// place.
void PlacedWindow::open(const std::string& title, bool quadBuffered) {
    constexpr std::array<std::array<int, 2>, 10> kHints{{
        {GLFW_CONTEXT_VERSION_MAJOR, 4},
        {GLFW_CONTEXT_VERSION_MINOR, 5},
        {GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE},
        {GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET},  // where the driver can tell
        {GLFW_DECORATED, GLFW_FALSE},                           // windows side by side are one wall
        {GLFW_RESIZABLE, GLFW_FALSE},
        {GLFW_AUTO_ICONIFY, GLFW_FALSE},  // one projector keeps showing when another is clicked
        {GLFW_VISIBLE, GLFW_FALSE},       // until it is in its place
        {GLFW_DEPTH_BITS, 0},             // the scene has a depth buffer of its own
        {GLFW_STENCIL_BITS, 0},
    }};
    for (const auto& [hint, value] : kHints) glfwWindowHint(hint, value);
    glfwWindowHint(GLFW_STEREO, quadBuffered ? GLFW_TRUE : GLFW_FALSE);
    GLFWmonitor* monitor = nullptr;
    if (display_.mode == config::DisplayMode::Fullscreen) {
        monitor = requireMonitor(display_.connector);
        glfwWindowHint(GLFW_REFRESH_RATE, requireMode(display_, size_, monitor).refreshRate);
    }
    window_.reset(glfwCreateWindow(size_.x, size_.y, title.c_str(), monitor, nullptr));
    if (!window_ && quadBuffered) {
        throw Error("no window with left and right buffers (" + lastGlfwError() +
                    "); switch quad-buffered stereo on in the graphics driver, or choose another "
                    "stereo mode in the rig");
    }
    if (!window_) {
        throw Error("no window with OpenGL 4.5 core (" + lastGlfwError() +
                    "); update the graphics driver, or use --headless");
    }
    if (monitor == nullptr && placesWindows())
        glfwSetWindowPos(window_.get(), display_.windowPosition.x, display_.windowPosition.y);
    // No pointer is shown on a whole monitor: it is part of the wall.
    if (monitor != nullptr) glfwSetInputMode(window_.get(), GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
    glfwShowWindow(window_.get());
    glfwPollEvents();
}

// A window whose pixels are not the projector's pixels would show a wrong warp, so the node refuses
// to start.
void PlacedWindow::check() {
    glm::ivec2 actual{};
    glfwGetFramebufferSize(window_.get(), &actual.x, &actual.y);
    framebuffer_ = actual;
    if (actual != size_) {
        throw Error("display: the window has " + text(actual) + " pixels, the channel " +
                    text(size_) + "; choose a monitor, scale or place where it fits");
    }
    requireRefresh(display_, ownMonitor());
}

GLFWmonitor* PlacedWindow::ownMonitor() const {
    return display_.mode == config::DisplayMode::Fullscreen ? requireMonitor(display_.connector)
                                                            : monitorUnder(display_.windowPosition);
}

// When a monitor goes, GLFW turns its window into an ordinary one, somewhere on the desktop, and
// leaves it there.
void PlacedWindow::keepInPlace() {
    constexpr auto kBetweenLooks = std::chrono::milliseconds(250);
    if (display_.mode != config::DisplayMode::Fullscreen || isTakenOff_) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - lookedAt_ < kBetweenLooks) return;
    lookedAt_ = now;
    if (GLFWmonitor* monitor = monitorAt(display_.connector))
        stayOn(monitor);
    else
        waitAside();
}

void PlacedWindow::stayOn(GLFWmonitor* monitor) {
    constexpr int kMostAttempts =
        8;  // then the node gives in to a window manager that overrides the position
    if (!isAside_ && isOn(monitor))
        attempts_ = 0;
    else if (attempts_++ < kMostAttempts)
        enter(monitor);
}

bool PlacedWindow::isOn(GLFWmonitor* monitor) const {
    if (glfwGetWindowMonitor(window_.get()) != monitor) return false;
    if (!placesWindows()) return true;
    glm::ivec2 place{};
    glfwGetWindowPos(window_.get(), &place.x, &place.y);
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    return place == cornerOf(monitor) && glm::ivec2(mode->width, mode->height) == size_ &&
           framebuffer_.load() == size_;
}

// The window goes beyond the desktop, where it covers no other channel, and is still drawn.
void PlacedWindow::waitAside() {
    attempts_ = 0;
    if (std::exchange(isAside_, true)) return;
    logWarning("monitor {} is gone; its channel is drawn without it until it is back",
               display_.connector);
    const glm::ivec2 place = -2 * size_;
    glfwSetWindowMonitor(
        window_.get(), nullptr, place.x, place.y, size_.x, size_.y, GLFW_DONT_CARE);
}

void PlacedWindow::enter(GLFWmonitor* monitor) {
    const GLFWvidmode* mode = modeOf(display_, size_, monitor);
    if (mode == nullptr) {
        logWarning("monitor {} has no mode of {}", display_.connector, text(size_));
        return;
    }
    if (std::exchange(isAside_, false)) logInfo("monitor {} is back", display_.connector);
    glfwSetWindowMonitor(window_.get(), monitor, 0, 0, size_.x, size_.y, mode->refreshRate);
    if (!placesWindows()) return;
    // Without a window manager GLFW leaves the window where it was.
    const glm::ivec2 corner = cornerOf(monitor);
    glfwSetWindowPos(window_.get(), corner.x, corner.y);
}

// GLFW reports the cursor in screen coordinates, which on a scaled desktop are larger than pixels:
// convert by the ratio of the two sizes.
glm::vec2 PlacedWindow::cursor() const {
    glm::dvec2 place{};
    glm::ivec2 size{};
    glfwGetCursorPos(window_.get(), &place.x, &place.y);
    glfwGetWindowSize(window_.get(), &size.x, &size.y);
    return {place * glm::dvec2(framebuffer_.load()) / glm::dvec2(glm::max(size, 1))};
}

// The size of the framebuffer may change; the picture is then fitted into it (show/window_fit.h).
void PlacedWindow::toggleFullscreen() {
    isTakenOff_ = glfwGetWindowMonitor(window_.get()) != nullptr;
    if (isTakenOff_) {
        const glm::ivec2 place = display_.windowPosition;
        glfwSetWindowMonitor(
            window_.get(), nullptr, place.x, place.y, size_.x, size_.y, GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor* monitor = ownMonitor();
    const GLFWvidmode mode = *glfwGetVideoMode(monitor);
    glfwSetWindowMonitor(window_.get(), monitor, 0, 0, mode.width, mode.height, mode.refreshRate);
}

}  // namespace aquarama::gl
