// SPDX-License-Identifier: Apache-2.0
// Where a node draws: a GLFW window, or EGL without any display. One interface for both.
#pragma once

#include <memory>
#include <string>

#include <glm/vec2.hpp>

#include "common/config/rig.h"

namespace aquarama {

class Context {
  public:
    virtual ~Context() = default;
    virtual void makeCurrent() = 0;
    // Puts the finished default framebuffer on the display; does nothing without one.
    virtual void swap() = 0;
    [[nodiscard]] virtual glm::ivec2 framebufferPixels() const = 0;
    // True where framebuffer 0 is a window's; false where there is none.
    [[nodiscard]] virtual bool hasWindow() const = 0;
    [[nodiscard]] virtual std::string description() const = 0;  // renderer and version, for the log
};

// OpenGL 4.5 core. device: auto | nvidia | mesa | surfaceless | device:N. Throws Error: no EGL, no
// such device, no GL 4.5.
[[nodiscard]] std::unique_ptr<Context> makeOffscreenContext(const std::string& device,
                                                            glm::ivec2 sizePixels);

}  // namespace aquarama
