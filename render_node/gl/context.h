// SPDX-License-Identifier: Apache-2.0
// What a visitor's hands hold at one moment: keys, the mouse that drags, a gamepad.
#pragma once

#include <bitset>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <glm/vec2.hpp>

#include "common/config/rig.h"

namespace aquarama::gl {

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

// Where a node draws: a GLFW window, or EGL without any display. One interface for both.

// Made, pumped and destroyed by the main thread; current on the thread that draws, which releases
// it before the main thread destroys it.
class Context {
  public:
    virtual ~Context() = default;
    virtual void makeCurrent() = 0;
    virtual void release() = 0;
    // Puts the finished default framebuffer on the display; does nothing without one.
    virtual void swap() = 0;
    [[nodiscard]] virtual glm::ivec2 framebufferPixels() const = 0;
    // True where framebuffer 0 is a window's; false where there is none.
    [[nodiscard]] virtual bool hasWindow() const = 0;
    // True where framebuffer 0 has a left and a right back buffer.
    [[nodiscard]] virtual bool quadBuffered() const { return false; }
    [[nodiscard]] virtual std::string description() const = 0;  // renderer and version, for the log
    // Why all that was made in it is gone, on the thread where it is current; nothing while it is
    // not.
    [[nodiscard]] virtual std::optional<std::string> loss() const = 0;

    // On the main thread: waits for window events no longer than this, and handles them.
    virtual void pumpEvents(std::chrono::milliseconds atMost) = 0;
    // Keys that were pressed, oldest first: a lower-case letter, ' ' or kEscapeKey. Closing the
    // window is kEscapeKey.
    [[nodiscard]] virtual std::optional<char> nextKey() = 0;
    // Where the left mouse button was pressed, oldest first, in the framebuffer's pixels from the
    // window's top left corner.
    [[nodiscard]] virtual std::optional<glm::vec2> nextClick() = 0;
    // Where the mouse points, as above; nothing while it is outside the window.
    [[nodiscard]] virtual std::optional<glm::vec2> pointer() const = 0;
    // What is held now; keys and mouse of this window only, gamepads of this machine.
    [[nodiscard]] virtual Hands hands() const = 0;
};

inline constexpr char kEscapeKey = '\x1b';
inline constexpr char kFullscreenKey = 'f';  // handled by the window itself

// OpenGL 4.5 core, current on this thread. device: auto | nvidia | mesa | surfaceless | device:N.
// Throws Error: no EGL, no such device, no GL 4.5.
[[nodiscard]] std::unique_ptr<Context> makeOffscreenContext(const std::string& device,
                                                            glm::ivec2 sizePixels);

// OpenGL 4.5 core in a window, current on no thread; the display's own GPU draws, whatever device
// the channel names. Throws Error: no display, no such monitor, a framebuffer or refresh rate that
// is not the channel's, no GL 4.5, no left and right buffers where they are asked for.
[[nodiscard]] std::unique_ptr<Context> makeWindowContext(const config::Display& display,
                                                         const std::string& title,
                                                         glm::ivec2 sizePixels,
                                                         bool quadBuffered = false);

// What the current context turned out to be; a driver may give less than it was asked for, and may
// lose what it gave.

// Throws Error, naming `where` and the driver, unless the current context is OpenGL 4.5 or later
// with all that our shaders take.
void requireDriver(const std::string& where);

// What is lacking of what we need, as "8 storage blocks in vertex shaders, it has 0"; nothing where
// nothing is. `limitOf` answers as glGetIntegerv does.
[[nodiscard]] std::optional<std::string> lackOf(const std::function<int(unsigned limit)>& limitOf);

[[nodiscard]] std::string rendererAndVersion();

// Why the current context is lost; nothing while it is not.
[[nodiscard]] std::optional<std::string> lossOfContext();

// The gamepads of this machine, by GLFW: they may come and go at any time.

// Of all that are there the one that is moved farthest from rest; at rest where there is none. On
// the main thread, after GLFW was begun.
[[nodiscard]] Pad movedPad();

}  // namespace aquarama::gl
