// SPDX-License-Identifier: Apache-2.0
#include "render_node/gl/window_input.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <glm/common.hpp>

namespace aquarama::gl {

namespace {

// Converts GLFW's axes, where down is positive and a released trigger is -1.
Pad padOf(const GLFWgamepadstate& state) {
    const auto& axes = state.axes;
    const auto trigger = [&](int axis) { return (axes[axis] + 1) / 2; };
    return {{axes[GLFW_GAMEPAD_AXIS_LEFT_X], -axes[GLFW_GAMEPAD_AXIS_LEFT_Y]},
            {axes[GLFW_GAMEPAD_AXIS_RIGHT_X], -axes[GLFW_GAMEPAD_AXIS_RIGHT_Y]},
            trigger(GLFW_GAMEPAD_AXIS_LEFT_TRIGGER),
            trigger(GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER)};
}

// The largest deflection of any axis, 0 to 1.
float deflectionOf(const Pad& pad) {
    return std::max({std::abs(pad.leftStick.x),
                     std::abs(pad.leftStick.y),
                     std::abs(pad.rightStick.x),
                     std::abs(pad.rightStick.y),
                     pad.leftTrigger,
                     pad.rightTrigger});
}

template <class T>
std::optional<T> takeFirst(std::deque<T>& queue) {
    if (queue.empty()) return std::nullopt;
    const T first = queue.front();
    queue.pop_front();
    return first;
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

void WindowInput::press(int key) {
    if (key == GLFW_KEY_ESCAPE)
        keys_.push_back(kEscapeKey);
    else if (key == GLFW_KEY_SPACE)
        keys_.push_back(' ');
    else if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z)
        keys_.push_back(static_cast<char>('a' + (key - GLFW_KEY_A)));
}

void WindowInput::click() {
    constexpr std::size_t kMostClicks = 16;
    if (clicks_.size() < kMostClicks) clicks_.push_back(window_.cursor());
}

void WindowInput::drag(bool begins) {
    dragFrom_ = begins ? std::optional(window_.cursor()) : std::nullopt;
}

std::optional<char> WindowInput::nextKey() {
    return takeFirst(keys_);
}

std::optional<glm::vec2> WindowInput::nextClick() {
    return takeFirst(clicks_);
}

// When the window loses the keyboard focus, GLFW reports all keys as released.
Hands WindowInput::hands() const {
    constexpr std::array<std::pair<int, HeldKey>, kHeldKeys> kKeys{{
        {GLFW_KEY_W, HeldKey::W},
        {GLFW_KEY_A, HeldKey::A},
        {GLFW_KEY_S, HeldKey::S},
        {GLFW_KEY_D, HeldKey::D},
        {GLFW_KEY_UP, HeldKey::Up},
        {GLFW_KEY_DOWN, HeldKey::Down},
        {GLFW_KEY_LEFT, HeldKey::Left},
        {GLFW_KEY_RIGHT, HeldKey::Right},
        {GLFW_KEY_PAGE_UP, HeldKey::PageUp},
        {GLFW_KEY_PAGE_DOWN, HeldKey::PageDown},
        {GLFW_KEY_HOME, HeldKey::Home},
        {GLFW_KEY_END, HeldKey::End},
    }};
    Hands hands;
    hands.pad = movedPad();
    for (const auto& [key, held] : kKeys)
        if (glfwGetKey(window_.handle(), key) == GLFW_PRESS) hands.hold(held);
    if (dragFrom_) {
        const glm::vec2 drag = window_.cursor() - *dragFrom_;
        const auto height = static_cast<float>(glm::max(window_.framebufferPixels().y, 1));
        hands.drag = glm::vec2(drag.x, -drag.y) / height;
    }
    return hands;
}

}  // namespace aquarama::gl
