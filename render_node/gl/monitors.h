// SPDX-License-Identifier: Apache-2.0
// The monitors of this machine, and the choice of a monitor and its video mode for a channel.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "common/config/rig.h"

struct GLFWmonitor;
struct GLFWvidmode;

namespace aquarama::gl {

// All functions are of the main thread, while a GlfwLibrary exists. Monitors are valid until GLFW
// handles events again.

// Those that show something now, as "HDMI-1 1920x1080 60 Hz".
[[nodiscard]] std::vector<std::string> describedMonitors();

// The monitor at this connector; without a name the only monitor. Null: it is not there now.
[[nodiscard]] GLFWmonitor* monitorAt(const std::string& connector);
// Throws Error where it is not there.
[[nodiscard]] GLFWmonitor* requireMonitor(const std::string& connector);
// The monitor that contains this point of the desktop; the first one where none does. Throws Error:
// this machine has no monitor.
[[nodiscard]] GLFWmonitor* monitorUnder(glm::ivec2 place);
// Its upper left corner on the desktop.
[[nodiscard]] glm::ivec2 cornerOf(GLFWmonitor* monitor);

// The monitor's video mode that has exactly the channel's size, and its refresh rate where one is
// given: a scaled picture would have a wrong warp. Null: it has none.
[[nodiscard]] const GLFWvidmode* modeOf(const config::Display& display,
                                        glm::ivec2 size,
                                        GLFWmonitor* monitor);
// Throws Error where the monitor has no such mode.
[[nodiscard]] const GLFWvidmode& requireMode(const config::Display& display,
                                             glm::ivec2 size,
                                             GLFWmonitor* monitor);
// Throws Error where the monitor's present mode has another refresh rate than the channel.
void requireRefresh(const config::Display& display, GLFWmonitor* monitor);

// "1920 x 1080", for messages.
[[nodiscard]] std::string text(glm::ivec2 size);

}  // namespace aquarama::gl
