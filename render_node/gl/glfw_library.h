// SPDX-License-Identifier: Apache-2.0
// GLFW for the life of an object, and what its platform permits.
#pragma once

#include <string>

namespace aquarama::gl {

// GLFW has one state for the process: only one window context may exist at a time.
class GlfwLibrary {
  public:
    // Throws Error where no window can be opened.
    GlfwLibrary();
    ~GlfwLibrary();
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;
};

// Whether a program can choose the place of its window: not under Wayland.
[[nodiscard]] bool placesWindows();

// The reason for GLFW's last failure, for messages; reading it clears it.
[[nodiscard]] std::string lastGlfwError();

}  // namespace aquarama::gl
