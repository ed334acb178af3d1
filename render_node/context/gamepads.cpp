// SPDX-License-Identifier: Apache-2.0
#include "render_node/context/gamepads.h"

#include <algorithm>
#include <array>
#include <cmath>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace aquarama::context {

namespace {

// GLFW's axes: down is positive; triggers are -1 at rest.
Pad padOf(const GLFWgamepadstate& state) {
    const auto& axes = state.axes;
    const auto trigger = [&](int axis) { return (axes[axis] + 1) / 2; };
    return {{axes[GLFW_GAMEPAD_AXIS_LEFT_X], -axes[GLFW_GAMEPAD_AXIS_LEFT_Y]},
            {axes[GLFW_GAMEPAD_AXIS_RIGHT_X], -axes[GLFW_GAMEPAD_AXIS_RIGHT_Y]},
            trigger(GLFW_GAMEPAD_AXIS_LEFT_TRIGGER),
            trigger(GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER)};
}

float deflectionOf(const Pad& pad) {
    return std::max({std::abs(pad.leftStick.x),
                     std::abs(pad.leftStick.y),
                     std::abs(pad.rightStick.x),
                     std::abs(pad.rightStick.y),
                     pad.leftTrigger,
                     pad.rightTrigger});
}

}  // namespace

Pad movedPad() {
    Pad moved;
    for (int joystick = GLFW_JOYSTICK_1; joystick <= GLFW_JOYSTICK_LAST; ++joystick) {
        GLFWgamepadstate state{};
        if (glfwGetGamepadState(joystick, &state) == GLFW_FALSE) continue;
        const Pad pad = padOf(state);
        if (deflectionOf(pad) > deflectionOf(moved)) moved = pad;
    }
    return moved;
}

}  // namespace aquarama::context
