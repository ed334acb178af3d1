// SPDX-License-Identifier: Apache-2.0
// The OpenGL context that a render node draws with, in a window or without a display, and what a
// visitor enters there: keys, mouse, gamepad.
#pragma once

#include <bitset>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "common/config/rig.h"

namespace aquarama::gl {

// Keys that steer for as long as they are held down. All other keys are events: see
// Context::nextKey().
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
    End
};
inline constexpr std::size_t kHeldKeys = static_cast<std::size_t>(HeldKey::End) + 1;

// A gamepad's axes. Sticks: -1 to 1, right and up positive; triggers: 0 released to 1 pressed.
struct Pad {
    glm::vec2 leftStick{};
    glm::vec2 rightStick{};
    float leftTrigger = 0;
    float rightTrigger = 0;
};

// All that a visitor holds at one moment. A plain value: copied from the main thread to wherever it
// is used.
struct Hands {
    // One bit for each HeldKey; read with holds().
    std::bitset<kHeldKeys> keys;
    // Vector from where the right mouse button was pressed to the pointer, in window heights: x
    // right, y up. Empty while the button is not pressed.
    std::optional<glm::vec2> drag;
    // Of several gamepads, the one that is deflected most.
    Pad pad;

    // Whether the key is down.
    [[nodiscard]] bool holds(HeldKey key) const {
        assert(static_cast<std::size_t>(key) < kHeldKeys);
        return keys[static_cast<std::size_t>(key)];
    }
    // Notes that the key is down.
    void hold(HeldKey key) {
        assert(static_cast<std::size_t>(key) < kHeldKeys);
        keys.set(static_cast<std::size_t>(key));
    }
};

// Holds the OpenGL objects of one picture, and has no framebuffer 0. A context has as many as it is
// asked for, so that a picture can be built on one thread while another thread draws one of another
// workspace. Textures are shared with the context: what was drawn is copied into its window. Used
// by one thread at a time; the context must outlive it.
class Workspace {
  public:
    virtual ~Workspace() = default;
    // Makes it current on the calling thread. Throws Error where the driver refuses.
    virtual void makeCurrent() = 0;
    // Releases it; it is then current on no thread.
    virtual void release() = 0;
};

// An OpenGL context: a GLFW window, or EGL without a display.

// Thread rules: the main thread creates the context, calls pumpEvents() and the functions for
// input, and destroys it. The drawing thread makes it or one of its workspaces current, draws, and
// releases it before the main thread destroys it.
class Context {
  public:
    virtual ~Context() = default;
    // May be called by any thread. Throws Error where the driver gives no more contexts.
    [[nodiscard]] virtual std::unique_ptr<Workspace> makeWorkspace() = 0;
    // Makes the context current on the calling thread. Throws Error where the driver refuses.
    virtual void makeCurrent() = 0;
    // Releases it; the context is then current on no thread.
    virtual void release() = 0;
    // Shows the finished default framebuffer on the display; does nothing without one. A window
    // swaps at the vertical blank.
    virtual void swap() = 0;
    // The last vertical blank of the window's display; empty where the driver does not report it.
    // On the drawing thread, with the context current.
    struct VerticalBlank {
        std::uint64_t count;
        std::chrono::steady_clock::time_point at;
    };
    [[nodiscard]] virtual std::optional<VerticalBlank> lastBlank() const { return std::nullopt; }
    // Width and height of framebuffer 0, in pixels; may be read by any thread.
    [[nodiscard]] virtual glm::ivec2 framebufferPixels() const = 0;
    // True where framebuffer 0 is a window's; false where there is none.
    [[nodiscard]] virtual bool hasWindow() const = 0;
    // True where framebuffer 0 has a left and a right back buffer.
    [[nodiscard]] virtual bool quadBuffered() const { return false; }
    // Renderer, version and kind of window, for the log. Needs the context to be current.
    [[nodiscard]] virtual std::string description() const = 0;
    // The reason why the driver has lost the context and every object in it; empty while it has
    // not. Needs the context to be current on the calling thread.
    [[nodiscard]] virtual std::optional<std::string> loss() const = 0;

    // The monitors of this machine, as "HDMI-1 1920x1080 60 Hz"; none without a display. Main
    // thread only.
    [[nodiscard]] virtual std::vector<std::string> monitors() const { return {}; }

    // Waits for window events for at most this long and handles them. Main thread only.
    virtual void pumpEvents(std::chrono::milliseconds atMost) = 0;
    // The next key that was pressed, oldest first: a lower-case letter, ' ' or kEscapeKey. Closing
    // the window counts as kEscapeKey. Empty when there is none. Main thread only.
    [[nodiscard]] virtual std::optional<char> nextKey() = 0;
    // The place of the next click of the left mouse button, oldest first: pixels of the framebuffer
    // from the window's top left corner. Main thread only.
    [[nodiscard]] virtual std::optional<glm::vec2> nextClick() = 0;
    // The place of the pointer, in the same coordinates; empty while it is outside the window.
    [[nodiscard]] virtual std::optional<glm::vec2> pointer() const = 0;
    // What is held at this moment: keys and mouse of this window, gamepads of this machine.
    [[nodiscard]] virtual Hands hands() const = 0;
};

// Escape as nextKey() returns it: ASCII ESC.
inline constexpr char kEscapeKey = '\x1b';
// Switches full screen on and off. The window handles it itself: nextKey() never returns it.
inline constexpr char kFullscreenKey = 'f';

// Creates an OpenGL 4.5 core context without a window, current on the calling thread. device: auto
// | nvidia | mesa | surfaceless | device:N (rig format). sizePixels is what framebufferPixels()
// returns: there is no framebuffer 0. Throws Error: no EGL, no such device, no GL 4.5.
[[nodiscard]] std::unique_ptr<Context> makeOffscreenContext(const std::string& device,
                                                            glm::ivec2 sizePixels);

// Creates an OpenGL 4.5 core context in a window, current on no thread. The display's own GPU
// draws, whatever device the channel names. Throws Error: no display, no such monitor, a
// framebuffer size or refresh rate that differs from the channel's, no GL 4.5, no left and right
// buffers where they are requested.
[[nodiscard]] std::unique_ptr<Context> makeWindowContext(const config::Display& display,
                                                         const std::string& title,
                                                         glm::ivec2 sizePixels,
                                                         bool quadBuffered = false);

// Checks of the current context: a driver may give less than was requested, and may lose the
// context later.

// Throws Error, naming `where` and the driver, unless the current context is OpenGL 4.5 or later
// and its limits are large enough for our shaders.
void requireDriver(const std::string& where);

// The first limit that is too low for our shaders, as "8 storage blocks in vertex shaders, it has
// 0"; empty where all suffice. `limitOf` returns the value of a GL_MAX_... limit, as glGetIntegerv
// does.
[[nodiscard]] std::optional<std::string> lackOf(const std::function<int(unsigned limit)>& limitOf);

// GL_RENDERER and GL_VERSION of the current context, for messages.
[[nodiscard]] std::string rendererAndVersion();

// The reason why the current context is lost, from glGetGraphicsResetStatus(); empty while it is
// not.
[[nodiscard]] std::optional<std::string> lossOfContext();

// Gamepads of this machine, read by GLFW. They may be plugged in or removed at any time.

// The state of the gamepad that is deflected most; all axes at rest where there is none. Main
// thread only, after GLFW was initialised.
[[nodiscard]] Pad movedPad();

}  // namespace aquarama::gl
