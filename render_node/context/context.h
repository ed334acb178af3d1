// SPDX-License-Identifier: Apache-2.0
// Where a node draws: a GLFW window, or EGL without any display. One interface for both.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include <glm/vec2.hpp>

#include "common/config/rig.h"
#include "render_node/context/hands.h"

namespace aquarama::context {

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

}  // namespace aquarama::context
