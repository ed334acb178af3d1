// SPDX-License-Identifier: Apache-2.0
#include "render_node/gl/monitor_windows.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "common/base/log.h"
#include "render_node/gl/monitors.h"

namespace aquarama::gl {

namespace {

bool isLeft(GLFWwindow* window) {
    return glfwWindowShouldClose(window) != GLFW_FALSE ||
           glfwGetKey(window, GLFW_KEY_Q) == GLFW_PRESS ||
           glfwGetKey(window, GLFW_KEY_ESCAPE) == GLFW_PRESS;
}

}  // namespace

void MonitorWindows::DestroyWindow::operator()(GLFWwindow* window) const {
    glfwDestroyWindow(window);
}

MonitorWindows::MonitorWindows(std::string title, std::string connector)
    : title_{std::move(title)}, connector_{std::move(connector)} {
    open();
}

std::vector<GLFWmonitor*> MonitorWindows::monitorsNow() const {
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    if (connector_.empty()) return {monitors, monitors + count};
    GLFWmonitor* monitor = monitorAt(connector_);
    return monitor == nullptr ? std::vector<GLFWmonitor*>{} : std::vector{monitor};
}

// In the mode that each monitor has now.
void MonitorWindows::open() {
    windows_.clear();
    monitors_ = monitorsNow();
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    for (GLFWmonitor* monitor : monitors_) {
        const GLFWvidmode* mode = glfwGetVideoMode(monitor);
        glfwWindowHint(GLFW_REFRESH_RATE, mode->refreshRate);
        windows_.emplace_back(
            glfwCreateWindow(mode->width, mode->height, title_.c_str(), monitor, nullptr));
        if (!windows_.back()) throw Error("no window with OpenGL (" + lastGlfwError() + ")");
        glfwSetInputMode(windows_.back().get(), GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
        // A key that is let go before it was asked for still counts.
        glfwSetInputMode(windows_.back().get(), GLFW_STICKY_KEYS, GLFW_TRUE);
        if (!placesWindows()) continue;
        glm::ivec2 corner{};
        glfwGetMonitorPos(monitor, &corner.x, &corner.y);
        glfwSetWindowPos(windows_.back().get(), corner.x, corner.y);
    }
}

bool MonitorWindows::pumpEvents(std::chrono::milliseconds atMost) {
    glfwWaitEventsTimeout(std::chrono::duration<double>(atMost).count());
    return std::ranges::any_of(windows_, [](const auto& window) { return isLeft(window.get()); });
}

void MonitorWindows::draw(const std::function<void(glm::ivec2 sizePixels)>& paint) {
    if (monitorsNow() != monitors_) open();
    for (const auto& window : windows_) {
        glfwMakeContextCurrent(window.get());
        glm::ivec2 size{};
        glfwGetFramebufferSize(window.get(), &size.x, &size.y);
        glViewport(0, 0, size.x, size.y);
        paint(size);
        glfwSwapBuffers(window.get());
    }
    glfwMakeContextCurrent(nullptr);
}

}  // namespace aquarama::gl
