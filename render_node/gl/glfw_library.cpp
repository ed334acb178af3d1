// SPDX-License-Identifier: Apache-2.0
#include "render_node/gl/glfw_library.h"

#include <cstdlib>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "common/base/log.h"

namespace aquarama::gl {

// Before 3.4 GLFW is built for X11 alone, and knows no other platform.
#ifdef GLFW_PLATFORM
namespace {

// Prefers X11 where both exist: the windows of a wall need exact positions, and Wayland does not
// let a program choose them.
void choosePlatform() {
    const bool hasX = std::getenv("DISPLAY") != nullptr;  // NOLINT(concurrency-mt-unsafe)
    glfwInitHint(GLFW_PLATFORM, hasX ? GLFW_PLATFORM_X11 : GLFW_ANY_PLATFORM);
}

}  // namespace

bool placesWindows() {
    return glfwGetPlatform() != GLFW_PLATFORM_WAYLAND;
}
#else
namespace {

void choosePlatform() {}

}  // namespace

bool placesWindows() {
    return true;
}
#endif

GlfwLibrary::GlfwLibrary() {
    choosePlatform();
    if (glfwInit() == GLFW_FALSE)
        throw Error("no window can be opened (" + lastGlfwError() +
                    "); set DISPLAY to an X display, or use --headless");
}

GlfwLibrary::~GlfwLibrary() {
    glfwTerminate();
}

std::string lastGlfwError() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description != nullptr ? description : "no reason given";
}

}  // namespace aquarama::gl
