// SPDX-License-Identifier: Apache-2.0
#include <cassert>
#include <chrono>
#include <string>

#include <epoxy/gl.h>
#include <epoxy/glx.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "render_node/gl/context.h"
#include "render_node/gl/glfw_library.h"
#include "render_node/gl/monitors.h"
#include "render_node/gl/placed_window.h"
#include "render_node/gl/window_input.h"
#include "render_node/gl/window_workspace.h"

namespace aquarama::gl {

namespace {

// The window of one channel. GLFW calls the callbacks from pumpEvents(), hence on the main thread.
class WindowContext final : public Context {
  public:
    WindowContext(const config::Display& display,
                  const std::string& title,
                  glm::ivec2 sizePixels,
                  bool quadBuffered)
        : window_{display, title, sizePixels, quadBuffered}, quadBuffered_{quadBuffered} {
        listen();
        makeCurrent();
        native_ = currentContext();
        countsBlanks_ =
            native_.x != nullptr &&
            epoxy_has_glx_extension(native_.x, DefaultScreen(native_.x), "GLX_OML_sync_control");
        blacken();
        release();
    }
    [[nodiscard]] std::unique_ptr<Workspace> makeWorkspace() override {
        return makeWorkspaceBeside(native_);
    }
    void makeCurrent() override {
        glfwMakeContextCurrent(window_.handle());
        // One swap for each vertical blank: no tearing.
        glfwSwapInterval(1);
        requireDriver("window");
    }
    void release() override { glfwMakeContextCurrent(nullptr); }
    void swap() override { glfwSwapBuffers(window_.handle()); }
    [[nodiscard]] std::optional<VerticalBlank> lastBlank() const override {
        const GLXDrawable window = glXGetCurrentDrawable();
        if (!countsBlanks_ || window == None) return std::nullopt;
        std::int64_t microseconds = 0, blanks = 0, swaps = 0;
        const auto told = glXGetSyncValuesOML(native_.x, window, &microseconds, &blanks, &swaps);
        if (told == False || blanks <= 0) return std::nullopt;
        return VerticalBlank{
            static_cast<std::uint64_t>(blanks),
            std::chrono::steady_clock::time_point{std::chrono::microseconds(microseconds)}};
    }
    [[nodiscard]] glm::ivec2 framebufferPixels() const override {
        return window_.framebufferPixels();
    }
    [[nodiscard]] bool hasWindow() const override { return true; }
    [[nodiscard]] bool quadBuffered() const override { return quadBuffered_; }
    [[nodiscard]] std::string description() const override {
        return rendererAndVersion() +
               (placesWindows() ? ", in a window" : ", in a window that Wayland places");
    }
    [[nodiscard]] std::optional<std::string> loss() const override { return lossOfContext(); }
    [[nodiscard]] std::vector<std::string> monitors() const override { return describedMonitors(); }
    void pumpEvents(std::chrono::milliseconds atMost) override {
        assert(atMost.count() >= 0);
        glfwWaitEventsTimeout(std::chrono::duration<double>(atMost).count());
        window_.keepInPlace();
    }
    [[nodiscard]] std::optional<char> nextKey() override { return input_.nextKey(); }
    [[nodiscard]] std::optional<glm::vec2> nextClick() override { return input_.nextClick(); }
    [[nodiscard]] std::optional<glm::vec2> pointer() const override {
        if (glfwGetWindowAttrib(window_.handle(), GLFW_HOVERED) == GLFW_FALSE) return std::nullopt;
        return window_.cursor();
    }
    [[nodiscard]] Hands hands() const override { return input_.hands(); }

  private:
    static WindowContext& of(GLFWwindow* source) {
        return *static_cast<WindowContext*>(glfwGetWindowUserPointer(source));
    }
    // The callbacks find this object by the user pointer, so it must not move.
    void listen() {
        GLFWwindow* window = window_.handle();
        glfwSetWindowUserPointer(window, this);
        glfwSetKeyCallback(window, [](GLFWwindow* source, int key, int, int action, int) {
            if (action == GLFW_PRESS) of(source).press(key);
        });
        glfwSetWindowCloseCallback(
            window, [](GLFWwindow* source) { of(source).input_.press(GLFW_KEY_ESCAPE); });
        glfwSetMouseButtonCallback(window, [](GLFWwindow* source, int button, int action, int) {
            WindowInput& input = of(source).input_;
            if (button == GLFW_MOUSE_BUTTON_LEFT && action == GLFW_PRESS) input.click();
            if (button == GLFW_MOUSE_BUTTON_RIGHT) input.drag(action == GLFW_PRESS);
        });
        glfwSetFramebufferSizeCallback(window, [](GLFWwindow* source, int width, int height) {
            of(source).window_.resized({width, height});
        });
    }
    void press(int key) {
        if (key == GLFW_KEY_F)
            window_.toggleFullscreen();
        else
            input_.press(key);
    }
    // Black until the first frame, whatever was on the screen before.
    void blacken() {
        glClearColor(0, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        swap();
    }

    // First, so that GLFW ends after the window.
    GlfwLibrary library_;
    PlacedWindow window_;
    WindowInput input_{window_};
    bool quadBuffered_;
    NativeContext native_;
    bool countsBlanks_ = false;
};

}  // namespace

std::unique_ptr<Context> makeWindowContext(const config::Display& display,
                                           const std::string& title,
                                           glm::ivec2 sizePixels,
                                           bool quadBuffered) {
    return std::make_unique<WindowContext>(display, title, sizePixels, quadBuffered);
}

}  // namespace aquarama::gl
