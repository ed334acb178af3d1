// SPDX-License-Identifier: Apache-2.0
// What a visitor's hands hold at one moment: keys, the mouse that drags, a gamepad.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <glm/vec2.hpp>

namespace aquarama::context {

enum class HeldKey : std::uint8_t {
    W,
    A,
    S,
    D,
    Up,
    Down,
    Left,
    Right,
    PageUp,
    PageDown,
    Home,
    End,
    kCount
};

// Sticks, -1 to 1, right and up positive; triggers 0 to 1.
struct Pad {
    glm::vec2 leftStick{};
    glm::vec2 rightStick{};
    float leftTrigger = 0;
    float rightTrigger = 0;
};

struct Hands {
    std::bitset<static_cast<std::size_t>(HeldKey::kCount)> keys;
    // From where the right mouse button was pressed to where it is: right and up, in heights of
    // the window; nothing while it is not pressed.
    std::optional<glm::vec2> drag;
    Pad pad;  // of several the one that is moved farthest

    [[nodiscard]] bool holds(HeldKey key) const { return keys[static_cast<std::size_t>(key)]; }
    void hold(HeldKey key) { keys.set(static_cast<std::size_t>(key)); }
};

}  // namespace aquarama::context
