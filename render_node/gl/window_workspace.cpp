// SPDX-License-Identifier: Apache-2.0
#include "render_node/gl/window_workspace.h"

#include <array>

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "common/base/log.h"
#include "render_node/gl/glfw_library.h"

namespace aquarama::gl {
namespace {

// The framebuffer configuration of a current context of GLX. Throws Error where it is not found.
GLXFBConfig configOf(Display* x, GLXContext context) {
    int id = 0, count = 0;
    glXQueryContext(x, context, GLX_FBCONFIG_ID, &id);
    const std::array wanted{GLX_FBCONFIG_ID, id, 0};
    GLXFBConfig* configs = glXChooseFBConfig(x, DefaultScreen(x), wanted.data(), &count);
    if (configs == nullptr || count == 0) throw Error("X does not know its own context");
    GLXFBConfig config = configs[0];
    XFree(configs);
    return config;
}

// Owns a context that GLFW does not know.
class WindowWorkspace final : public Workspace {
  public:
    explicit WindowWorkspace(const NativeContext& window) : window_{window} {
        if (window_.x != nullptr) {
            const std::array attributes{GLX_CONTEXT_MAJOR_VERSION_ARB,
                                        4,
                                        GLX_CONTEXT_MINOR_VERSION_ARB,
                                        5,
                                        GLX_CONTEXT_PROFILE_MASK_ARB,
                                        GLX_CONTEXT_CORE_PROFILE_BIT_ARB,
                                        window_.toldOfReset ? GLX_CONTEXT_FLAGS_ARB : 0,
                                        GLX_CONTEXT_ROBUST_ACCESS_BIT_ARB,
                                        GLX_CONTEXT_RESET_NOTIFICATION_STRATEGY_ARB,
                                        GLX_LOSE_CONTEXT_ON_RESET_ARB,
                                        0};
            glx_ = glXCreateContextAttribsARB(
                window_.x, window_.glxConfig, window_.glx, True, attributes.data());
        } else {
            const std::array attributes{
                EGL_CONTEXT_MAJOR_VERSION,
                4,
                EGL_CONTEXT_MINOR_VERSION,
                5,
                EGL_CONTEXT_OPENGL_PROFILE_MASK,
                EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                window_.toldOfReset ? EGL_CONTEXT_OPENGL_ROBUST_ACCESS : EGL_NONE,
                EGL_TRUE,
                EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                EGL_LOSE_CONTEXT_ON_RESET,
                EGL_NONE};
            eglBindAPI(EGL_OPENGL_API);
            egl_ = eglCreateContext(
                window_.egl, window_.eglConfig, window_.eglContext, attributes.data());
        }
        if (glx_ == nullptr && egl_ == EGL_NO_CONTEXT)
            throw Error("the graphics driver gives no more contexts; restart the node");
    }
    ~WindowWorkspace() override {
        if (glx_ != nullptr) glXDestroyContext(window_.x, glx_);
        if (egl_ != EGL_NO_CONTEXT) eglDestroyContext(window_.egl, egl_);
    }
    WindowWorkspace(const WindowWorkspace&) = delete;
    WindowWorkspace& operator=(const WindowWorkspace&) = delete;

    void makeCurrent() override {
        glfwMakeContextCurrent(nullptr);
        bool done = false;
        if (glx_ != nullptr) {
            done = glXMakeContextCurrent(window_.x, None, None, glx_) != False;
        } else {
            eglBindAPI(EGL_OPENGL_API);
            done = eglMakeCurrent(window_.egl, EGL_NO_SURFACE, EGL_NO_SURFACE, egl_) != EGL_FALSE;
        }
        if (!done)
            throw Error(
                "the graphics driver refuses a context without a window; update the driver");
    }
    void release() override {
        if (glx_ != nullptr) glXMakeContextCurrent(window_.x, None, None, nullptr);
        if (egl_ != EGL_NO_CONTEXT)
            eglMakeCurrent(window_.egl, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }

  private:
    NativeContext window_;
    GLXContext glx_ = nullptr;
    EGLContext egl_ = EGL_NO_CONTEXT;
};

}  // namespace

NativeContext currentContext() {
    NativeContext native;
    GLint strategy = 0;
    glGetIntegerv(GL_RESET_NOTIFICATION_STRATEGY, &strategy);
    native.toldOfReset = strategy == GL_LOSE_CONTEXT_ON_RESET;
    if (placesWindows()) {
        native.x = glXGetCurrentDisplay();
        native.glx = glXGetCurrentContext();
        native.glxConfig = configOf(native.x, native.glx);
        return native;
    }
    native.egl = eglGetCurrentDisplay();
    native.eglContext = eglGetCurrentContext();
    EGLint id = 0, count = 0;
    eglQueryContext(native.egl, native.eglContext, EGL_CONFIG_ID, &id);
    const std::array wanted{EGL_CONFIG_ID, id, EGL_NONE};
    eglChooseConfig(native.egl, wanted.data(), &native.eglConfig, 1, &count);
    return native;
}

std::unique_ptr<Workspace> makeWorkspaceBeside(const NativeContext& window) {
    return std::make_unique<WindowWorkspace>(window);
}

}  // namespace aquarama::gl
