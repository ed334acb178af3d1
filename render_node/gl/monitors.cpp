// SPDX-License-Identifier: Apache-2.0
#include "render_node/gl/monitors.h"

#include <algorithm>
#include <cmath>
#include <span>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <glm/common.hpp>

#include "common/base/log.h"
#include "common/machine/connectors.h"

namespace aquarama::gl {
namespace {

// GLFW reports whole hertz only: 59.94 appears as 59 or 60.
constexpr double kRefreshToleranceHertz = 1.0;

std::span<GLFWmonitor*> allMonitors() {
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    return {monitors, static_cast<std::size_t>(count)};
}

// The name of its connector: "HDMI-1".
std::string nameOf(GLFWmonitor* monitor) {
    return machine::connectorName(glfwGetMonitorName(monitor));
}

// "HDMI-1, DP-2".
std::string monitorNames() {
    std::string names;
    for (GLFWmonitor* monitor : allMonitors())
        names += (names.empty() ? "" : ", ") + nameOf(monitor);
    return names.empty() ? "none" : names;
}

bool refreshDiffers(const config::Display& display, const GLFWvidmode& mode) {
    return display.refreshHertz &&
           std::abs(*display.refreshHertz - mode.refreshRate) >= kRefreshToleranceHertz;
}

std::string described(const GLFWvidmode& mode) {
    return text({mode.width, mode.height}) + " at " + std::to_string(mode.refreshRate) + " Hz";
}

}  // namespace

std::string text(glm::ivec2 size) {
    return std::to_string(size.x) + " x " + std::to_string(size.y);
}

std::vector<std::string> describedMonitors() {
    std::vector<std::string> texts;
    for (GLFWmonitor* monitor : allMonitors()) {
        const GLFWvidmode& mode = *glfwGetVideoMode(monitor);
        texts.push_back(nameOf(monitor) + " " + std::to_string(mode.width) + "x" +
                        std::to_string(mode.height) + " " + std::to_string(mode.refreshRate) +
                        " Hz");
    }
    return texts;
}

GLFWmonitor* monitorAt(const std::string& connector) {
    const auto monitors = allMonitors();
    if (connector.empty()) return monitors.size() == 1 ? monitors.front() : nullptr;
    const auto found = std::ranges::find(monitors, connector, nameOf);
    return found == monitors.end() ? nullptr : *found;
}

GLFWmonitor* requireMonitor(const std::string& connector) {
    if (GLFWmonitor* monitor = monitorAt(connector)) return monitor;
    if (connector.empty() && !allMonitors().empty())
        throw Error("display: this machine has several monitors (" + monitorNames() +
                    "); name the channel's in its display, as connector: \"HDMI-1\"");
    throw Error("display: there is no monitor " + connector + "; this machine has " +
                monitorNames() + ": correct the channel's connector, or check its cable");
}

GLFWmonitor* monitorUnder(glm::ivec2 place) {
    const auto monitors = allMonitors();
    if (monitors.empty()) throw Error("display: this machine has no monitor; check its cables");
    const auto contains = [place](GLFWmonitor* monitor) {
        const GLFWvidmode* mode = glfwGetVideoMode(monitor);
        const glm::ivec2 inside = place - cornerOf(monitor);
        return inside ==
               glm::clamp(inside, glm::ivec2(0), glm::ivec2(mode->width, mode->height) - 1);
    };
    const auto found = std::ranges::find_if(monitors, contains);
    return found == monitors.end() ? monitors.front() : *found;
}

glm::ivec2 cornerOf(GLFWmonitor* monitor) {
    glm::ivec2 corner{};
    glfwGetMonitorPos(monitor, &corner.x, &corner.y);
    return corner;
}

const GLFWvidmode* modeOf(const config::Display& display, glm::ivec2 size, GLFWmonitor* monitor) {
    int count = 0;
    const GLFWvidmode* modes = glfwGetVideoModes(monitor, &count);
    for (const GLFWvidmode& mode : std::span{modes, static_cast<std::size_t>(count)})
        if (glm::ivec2(mode.width, mode.height) == size && !refreshDiffers(display, mode))
            return &mode;
    return nullptr;
}

const GLFWvidmode& requireMode(const config::Display& display,
                               glm::ivec2 size,
                               GLFWmonitor* monitor) {
    if (const GLFWvidmode* mode = modeOf(display, size, monitor)) return *mode;
    const std::string wanted =
        text(size) + (display.refreshHertz
                          ? " at " + std::to_string(std::lround(*display.refreshHertz)) + " Hz"
                          : "");
    throw Error("display: monitor " + nameOf(monitor) + " cannot show the channel's " + wanted +
                ", it is at " + described(*glfwGetVideoMode(monitor)) +
                "; correct the channel's size or refresh rate, or the cable's monitor");
}

void requireRefresh(const config::Display& display, GLFWmonitor* monitor) {
    const GLFWvidmode mode = *glfwGetVideoMode(monitor);
    if (!refreshDiffers(display, mode)) return;
    throw Error("display: monitor " + nameOf(monitor) + " runs " + described(mode) +
                ", the channel wants " + std::to_string(*display.refreshHertz) +
                " Hz; set the monitor or the channel's refresh rate");
}

}  // namespace aquarama::gl
