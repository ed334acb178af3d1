// SPDX-License-Identifier: Apache-2.0
// A workspace beside the context of a window, through GLX or EGL: GLFW makes contexts with a window
// only.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <epoxy/egl.h>
#include <epoxy/glx.h>

#include "render_node/gl/context.h"

namespace aquarama::gl {

// The context of a window and its configuration: GLX under X, else EGL. Workspaces share its
// textures.
struct NativeContext {
    Display* x = nullptr;  // null: EGL
    GLXContext glx = nullptr;
    GLXFBConfig glxConfig = nullptr;
    EGLDisplay egl = EGL_NO_DISPLAY;
    EGLContext eglContext = EGL_NO_CONTEXT;
    EGLConfig eglConfig = nullptr;
    bool toldOfReset = false;  // only contexts that are alike in this may share
};

// The context that GLFW has made current. Throws Error where X does not know it.
[[nodiscard]] NativeContext currentContext();
// Throws Error where the driver gives no more contexts.
[[nodiscard]] std::unique_ptr<Workspace> makeWorkspaceBeside(const NativeContext& window);

}  // namespace aquarama::gl
