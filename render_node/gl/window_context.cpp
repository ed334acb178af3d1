// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <span>
#include <string>
#include <utility>

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <epoxy/glx.h>
#define GLFW_INCLUDE_NONE
#include <algorithm>

#include <GLFW/glfw3.h>
#include <glm/common.hpp>

#include "common/base/log.h"
#include "common/machine/connectors.h"
#include "render_node/gl/context.h"

namespace aquarama::gl {

namespace {

// GLFW reports whole hertz only: 59.94 appears as 59 or 60.
constexpr double kRefreshToleranceHertz = 1.0;

std::string text(glm::ivec2 size) {
    return std::to_string(size.x) + " x " + std::to_string(size.y);
}

// The reason for the last failure, for our message; reading it clears it.
std::string lastGlfwError() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description != nullptr ? description : "no reason given";
}

// Before 3.4 GLFW is built for X11 alone, and knows no other platform.
#ifdef GLFW_PLATFORM
// Prefers X11 where both exist: the windows of a wall need exact positions, and Wayland does not
// let a program choose them.
void choosePlatform() {
    const bool hasX = std::getenv("DISPLAY") != nullptr;  // NOLINT(concurrency-mt-unsafe)
    glfwInitHint(GLFW_PLATFORM, hasX ? GLFW_PLATFORM_X11 : GLFW_ANY_PLATFORM);
}

bool placesWindows() {
    return glfwGetPlatform() != GLFW_PLATFORM_WAYLAND;
}
#else
void choosePlatform() {}

bool placesWindows() {
    return true;
}
#endif

// Initialises GLFW for the life of the object. GLFW has one state for the process: only one window
// context may exist at a time.
class GlfwLibrary {
  public:
    GlfwLibrary() {
        choosePlatform();
        if (glfwInit() == GLFW_FALSE) {
            throw Error("no window can be opened (" + lastGlfwError() +
                        "); set DISPLAY to an X display, or use --headless");
        }
    }
    ~GlfwLibrary() { glfwTerminate(); }
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;
};

// Those that show something now; valid until the next pumpEvents().
std::span<GLFWmonitor*> allMonitors() {
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    return {monitors, static_cast<std::size_t>(count)};
}

// "HDMI-1, DP-2", as their connectors are named.
std::string monitorNames() {
    std::string names;
    for (GLFWmonitor* monitor : allMonitors())
        names += (names.empty() ? "" : ", ") + machine::connectorName(glfwGetMonitorName(monitor));
    return names.empty() ? "none" : names;
}

// At this connector; without a name the only one. Null: not there now.
GLFWmonitor* monitorAt(const std::string& connector) {
    const auto monitors = allMonitors();
    if (connector.empty()) return monitors.size() == 1 ? monitors.front() : nullptr;
    const auto found = std::ranges::find(monitors, connector, [](GLFWmonitor* monitor) {
        return machine::connectorName(glfwGetMonitorName(monitor));
    });
    return found == monitors.end() ? nullptr : *found;
}

// The same. Throws Error where it is not there.
GLFWmonitor* requireMonitor(const std::string& connector) {
    if (GLFWmonitor* monitor = monitorAt(connector)) return monitor;
    if (connector.empty() && !allMonitors().empty())
        throw Error("display: this machine has several monitors (" + monitorNames() +
                    "); name the channel's in its display, as connector: \"HDMI-1\"");
    throw Error("display: there is no monitor " + connector + "; this machine has " +
                monitorNames() + ": correct the channel's connector, or see its cable");
}

bool refreshDiffers(const config::Display& display, const GLFWvidmode& mode) {
    return display.refreshHertz &&
           std::abs(*display.refreshHertz - mode.refreshRate) >= kRefreshToleranceHertz;
}

std::string described(const GLFWvidmode& mode) {
    return text({mode.width, mode.height}) + " at " + std::to_string(mode.refreshRate) + " Hz";
}

// The video mode of the monitor that has exactly the channel's size, and its refresh rate where one
// is given: a scaled picture would have a wrong warp. Null: it has none.
const GLFWvidmode* modeOf(const config::Display& display, glm::ivec2 size, GLFWmonitor* monitor) {
    int count = 0;
    const GLFWvidmode* modes = glfwGetVideoModes(monitor, &count);
    for (const GLFWvidmode& mode : std::span{modes, static_cast<std::size_t>(count)})
        if (glm::ivec2(mode.width, mode.height) == size && !refreshDiffers(display, mode))
            return &mode;
    return nullptr;
}

// Of a monitor without that mode.
[[noreturn]] void refuseMode(const config::Display& display,
                             glm::ivec2 size,
                             GLFWmonitor* monitor) {
    const std::string wanted =
        text(size) + (display.refreshHertz
                          ? " at " + std::to_string(std::lround(*display.refreshHertz)) + " Hz"
                          : "");
    throw Error("display: monitor " + machine::connectorName(glfwGetMonitorName(monitor)) +
                " cannot show the channel's " + wanted + ", it is at " +
                described(*glfwGetVideoMode(monitor)) +
                "; correct the channel's size or refresh rate, or the cable's monitor");
}

// Its place on the desktop.
glm::ivec2 cornerOf(GLFWmonitor* monitor) {
    glm::ivec2 corner{};
    glfwGetMonitorPos(monitor, &corner.x, &corner.y);
    return corner;
}

// The monitor that contains this point of the desktop; the first one where none does. Throws Error:
// there is none at all.
GLFWmonitor* monitorUnder(glm::ivec2 place) {
    const auto monitors = allMonitors();
    if (monitors.empty()) throw Error("display: this machine has no monitor; see its cables");
    const auto contains = [place](GLFWmonitor* monitor) {
        const GLFWvidmode* mode = glfwGetVideoMode(monitor);
        const glm::ivec2 inside = place - cornerOf(monitor);
        return inside ==
               glm::clamp(inside, glm::ivec2(0), glm::ivec2(mode->width, mode->height) - 1);
    };
    const auto found = std::ranges::find_if(monitors, contains);
    return found == monitors.end() ? monitors.front() : *found;
}

// Deleter of std::unique_ptr<GLFWwindow>.
struct DestroyWindow {
    void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};

// GLFW's own context and its configuration: GLX under X, else EGL. Textures of others are shared
// with it.
struct NativeContext {
    Display* x = nullptr;  // null: EGL
    GLXContext glx = nullptr;
    GLXFBConfig glxConfig = nullptr;
    EGLDisplay egl = EGL_NO_DISPLAY;
    EGLContext eglContext = EGL_NO_CONTEXT;
    EGLConfig eglConfig = nullptr;
    bool toldOfReset = false;  // only contexts that are alike in this may share
};

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

// Of the context that GLFW has made current.
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

// Owns a context beside that of a window, of which GLFW knows nothing.
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

// The window of one channel. GLFW calls the callbacks from pumpEvents(), hence on the main thread;
// only framebuffer_ is also read by the drawing thread.
class WindowContext : public Context {
  public:
    WindowContext(const config::Display& display,
                  const std::string& title,
                  glm::ivec2 sizePixels,
                  bool quadBuffered)
        : display_{display}, size_{sizePixels}, quadBuffered_{quadBuffered} {
        assert(size_.x > 0);
        assert(size_.y > 0);
        open(title);
        GLFWwindow* window = window_.get();
        // The callbacks find this object by the user pointer, so it must not move.
        glfwSetWindowUserPointer(window, this);
        glfwSetKeyCallback(window, [](GLFWwindow* source, int key, int, int action, int) {
            if (action == GLFW_PRESS) of(source).onKey(key);
        });
        glfwSetWindowCloseCallback(window,
                                   [](GLFWwindow* source) { of(source).onKey(GLFW_KEY_ESCAPE); });
        glfwSetMouseButtonCallback(window, [](GLFWwindow* source, int button, int action, int) {
            if (button == GLFW_MOUSE_BUTTON_LEFT && action == GLFW_PRESS) of(source).onClick();
            if (button == GLFW_MOUSE_BUTTON_RIGHT) of(source).onDrag(action == GLFW_PRESS);
        });
        glfwSetFramebufferSizeCallback(window, [](GLFWwindow* source, int width, int height) {
            of(source).framebuffer_ = glm::ivec2(width, height);
        });
        check();
        makeCurrent();
        native_ = currentContext();
        countsBlanks_ =
            native_.x != nullptr &&
            epoxy_has_glx_extension(native_.x, DefaultScreen(native_.x), "GLX_OML_sync_control");
        blacken();
        release();
    }
    [[nodiscard]] std::unique_ptr<Workspace> makeWorkspace() override {
        return std::make_unique<WindowWorkspace>(native_);
    }
    void makeCurrent() override {
        glfwMakeContextCurrent(window_.get());
        // One swap for each vertical blank: no tearing.
        glfwSwapInterval(1);
        requireDriver("window");
    }
    void release() override { glfwMakeContextCurrent(nullptr); }
    void swap() override { glfwSwapBuffers(window_.get()); }
    [[nodiscard]] std::optional<VerticalBlank> lastBlank() const override {
        const GLXDrawable window = glXGetCurrentDrawable();
        if (!countsBlanks_ || window == None) return std::nullopt;
        std::int64_t microseconds = 0, blanks = 0, swaps = 0;
        const auto told = glXGetSyncValuesOML(native_.x, window, &microseconds, &blanks, &swaps);
        if (told == False || blanks <= 0) return std::nullopt;
        return VerticalBlank{static_cast<std::uint64_t>(blanks),
                             std::chrono::microseconds(microseconds)};
    }
    [[nodiscard]] glm::ivec2 framebufferPixels() const override { return framebuffer_; }
    [[nodiscard]] bool hasWindow() const override { return true; }
    [[nodiscard]] bool quadBuffered() const override { return quadBuffered_; }
    [[nodiscard]] std::string description() const override {
        return rendererAndVersion() +
               (placesWindows() ? ", in a window" : ", in a window that Wayland places");
    }
    [[nodiscard]] std::optional<std::string> loss() const override { return lossOfContext(); }
    [[nodiscard]] std::vector<std::string> monitors() const override {
        std::vector<std::string> texts;
        for (GLFWmonitor* monitor : allMonitors()) {
            const GLFWvidmode& mode = *glfwGetVideoMode(monitor);
            texts.push_back(machine::connectorName(glfwGetMonitorName(monitor)) + " " +
                            std::to_string(mode.width) + "x" + std::to_string(mode.height) + " " +
                            std::to_string(mode.refreshRate) + " Hz");
        }
        return texts;
    }
    void pumpEvents(std::chrono::milliseconds atMost) override {
        assert(atMost.count() >= 0);
        glfwWaitEventsTimeout(std::chrono::duration<double>(atMost).count());
        keepInPlace();
    }
    [[nodiscard]] std::optional<char> nextKey() override {
        if (keys_.empty()) return std::nullopt;
        const char key = keys_.front();
        keys_.pop_front();
        return key;
    }

    [[nodiscard]] std::optional<glm::vec2> nextClick() override {
        if (clicks_.empty()) return std::nullopt;
        const glm::vec2 place = clicks_.front();
        clicks_.pop_front();
        return place;
    }
    [[nodiscard]] std::optional<glm::vec2> pointer() const override {
        if (glfwGetWindowAttrib(window_.get(), GLFW_HOVERED) == GLFW_FALSE) return std::nullopt;
        return cursor();
    }
    [[nodiscard]] Hands hands() const override;

  private:
    static WindowContext& of(GLFWwindow* source) {
        return *static_cast<WindowContext*>(glfwGetWindowUserPointer(source));
    }
    // Creates and places the window.
    void open(const std::string& title);
    // Throws Error unless size and refresh rate are the channel's.
    void check();
    void onKey(int key);
    void onClick();
    void onDrag(bool begins);
    // Place of the pointer in pixels of the framebuffer, from the top left corner.
    [[nodiscard]] glm::vec2 cursor() const;
    void toggleFullscreen();
    // The channel's, or that under its window. Throws Error where there is none.
    [[nodiscard]] GLFWmonitor* ownMonitor() const {
        return display_.mode == config::DisplayMode::Fullscreen
                   ? requireMonitor(display_.connector)
                   : monitorUnder(display_.windowPosition);
    }
    // Black until the first frame, whatever was on the screen before.
    void blacken();
    // Monitors come, go and move while the channel is drawn: its window goes with its connector.
    void keepInPlace();
    [[nodiscard]] bool isOn(GLFWmonitor* monitor) const;
    void stayOn(GLFWmonitor* monitor);
    void waitAside();
    void enter(GLFWmonitor* monitor);

    // First, so that GLFW ends after the window.
    GlfwLibrary library_;
    config::Display display_;
    glm::ivec2 size_;
    bool quadBuffered_;
    std::unique_ptr<GLFWwindow, DestroyWindow> window_;
    NativeContext native_;
    bool countsBlanks_ = false;
    std::atomic<glm::ivec2> framebuffer_{glm::ivec2(0)};
    // Whether its monitor is gone, and by the key f it has no whole monitor for now.
    bool isAside_ = false;
    bool isTakenOff_ = false;
    int attempts_ = 0;  // to enter its monitor
    std::chrono::steady_clock::time_point lookedAt_;
    // Pressed, not yet taken by nextKey().
    std::deque<char> keys_;
    std::deque<glm::vec2> clicks_;
    // Where the right button was pressed, as cursor(); empty while it is up.
    std::optional<glm::vec2> dragFrom_;
};

// The hints must be set before the window is created. The window stays hidden until it is at its
// place.
void WindowContext::open(const std::string& title) {
    constexpr std::array<std::array<int, 2>, 10> kHints{{
        {GLFW_CONTEXT_VERSION_MAJOR, 4},
        {GLFW_CONTEXT_VERSION_MINOR, 5},
        {GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE},
        {GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET},  // where the driver can tell
        {GLFW_DECORATED, GLFW_FALSE},                           // windows side by side are one wall
        {GLFW_RESIZABLE, GLFW_FALSE},
        {GLFW_AUTO_ICONIFY, GLFW_FALSE},  // one projector keeps showing when another is clicked
        {GLFW_VISIBLE, GLFW_FALSE},       // until it is in its place
        {GLFW_DEPTH_BITS, 0},             // the scene has a depth buffer of its own
        {GLFW_STENCIL_BITS, 0},
    }};
    for (const auto& [hint, value] : kHints) glfwWindowHint(hint, value);
    glfwWindowHint(GLFW_STEREO, quadBuffered_ ? GLFW_TRUE : GLFW_FALSE);
    GLFWmonitor* monitor = nullptr;
    if (display_.mode == config::DisplayMode::Fullscreen) {
        monitor = requireMonitor(display_.connector);
        const GLFWvidmode* mode = modeOf(display_, size_, monitor);
        if (mode == nullptr) refuseMode(display_, size_, monitor);
        glfwWindowHint(GLFW_REFRESH_RATE, mode->refreshRate);
    }
    window_.reset(glfwCreateWindow(size_.x, size_.y, title.c_str(), monitor, nullptr));
    if (!window_ && quadBuffered_) {
        throw Error("no window with left and right buffers (" + lastGlfwError() +
                    "); switch quad-buffered stereo on in the graphics driver, or choose another "
                    "stereo mode in the rig");
    }
    if (!window_) {
        throw Error("no window with OpenGL 4.5 core (" + lastGlfwError() +
                    "); update the graphics driver, or use --headless");
    }
    if (monitor == nullptr && placesWindows())
        glfwSetWindowPos(window_.get(), display_.windowPosition.x, display_.windowPosition.y);
    // A whole monitor is for those who look at the wall: no pointer lies on it.
    if (monitor != nullptr) glfwSetInputMode(window_.get(), GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
    glfwShowWindow(window_.get());
    glfwPollEvents();
}

void WindowContext::blacken() {
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    swap();
}

// GLFW makes an ordinary window of one whose monitor goes, somewhere on the desktop, and leaves it
// there.
void WindowContext::keepInPlace() {
    constexpr auto kBetweenLooks = std::chrono::milliseconds(250);
    if (display_.mode != config::DisplayMode::Fullscreen || isTakenOff_) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - lookedAt_ < kBetweenLooks) return;
    lookedAt_ = now;
    if (GLFWmonitor* monitor = monitorAt(display_.connector))
        stayOn(monitor);
    else
        waitAside();
}

void WindowContext::stayOn(GLFWmonitor* monitor) {
    constexpr int kMostAttempts = 8;  // where a window manager has its own mind
    if (!isAside_ && isOn(monitor))
        attempts_ = 0;
    else if (attempts_++ < kMostAttempts)
        enter(monitor);
}

// A window in its mode at its corner.
bool WindowContext::isOn(GLFWmonitor* monitor) const {
    if (glfwGetWindowMonitor(window_.get()) != monitor) return false;
    if (!placesWindows()) return true;
    glm::ivec2 place{};
    glfwGetWindowPos(window_.get(), &place.x, &place.y);
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    return place == cornerOf(monitor) && glm::ivec2(mode->width, mode->height) == size_ &&
           framebuffer_.load() == size_;
}

// Beyond the desktop, where it covers no other channel; it is drawn on.
void WindowContext::waitAside() {
    attempts_ = 0;
    if (std::exchange(isAside_, true)) return;
    logWarning("monitor {} is gone; its channel is drawn on until it is back", display_.connector);
    const glm::ivec2 place = -2 * size_;
    glfwSetWindowMonitor(
        window_.get(), nullptr, place.x, place.y, size_.x, size_.y, GLFW_DONT_CARE);
}

void WindowContext::enter(GLFWmonitor* monitor) {
    const GLFWvidmode* mode = modeOf(display_, size_, monitor);
    if (mode == nullptr) {
        logWarning("monitor {} has no mode of {}", display_.connector, text(size_));
        return;
    }
    if (std::exchange(isAside_, false)) logInfo("monitor {} is back", display_.connector);
    glfwSetWindowMonitor(window_.get(), monitor, 0, 0, size_.x, size_.y, mode->refreshRate);
    if (!placesWindows()) return;
    // Without a window manager GLFW leaves the window where it was.
    const glm::ivec2 corner = cornerOf(monitor);
    glfwSetWindowPos(window_.get(), corner.x, corner.y);
}

// A window whose pixels are not the projector's pixels would show a wrong warp, so the node refuses
// to start.
void WindowContext::check() {
    glm::ivec2 actual{};
    glfwGetFramebufferSize(window_.get(), &actual.x, &actual.y);
    framebuffer_ = actual;
    if (actual != size_) {
        throw Error("display: the window has " + text(actual) + " pixels, the channel " +
                    text(size_) + "; choose a monitor, scale or place where it fits");
    }
    GLFWmonitor* monitor = ownMonitor();
    const GLFWvidmode mode = *glfwGetVideoMode(monitor);
    if (refreshDiffers(display_, mode)) {
        throw Error("display: monitor " + machine::connectorName(glfwGetMonitorName(monitor)) +
                    " runs " + described(mode) + ", the channel wants " +
                    std::to_string(*display_.refreshHertz) +
                    " Hz; set the monitor or the channel's refresh rate");
    }
}

void WindowContext::onKey(int key) {
    if (key == GLFW_KEY_F)
        toggleFullscreen();
    else if (key == GLFW_KEY_ESCAPE)
        keys_.push_back(kEscapeKey);
    else if (key == GLFW_KEY_SPACE)
        keys_.push_back(' ');
    else if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z)
        keys_.push_back(static_cast<char>('a' + (key - GLFW_KEY_A)));
}

// Keeps at most so many clicks and drops later ones: while a window draws nothing yet, nobody takes
// them.
void WindowContext::onClick() {
    constexpr std::size_t kMostClicks = 16;
    if (clicks_.size() < kMostClicks) clicks_.push_back(cursor());
}

void WindowContext::onDrag(bool begins) {
    dragFrom_ = begins ? std::optional(cursor()) : std::nullopt;
}

// When the window loses the keyboard focus, GLFW reports all keys as released.
Hands WindowContext::hands() const {
    constexpr std::array<std::pair<int, HeldKey>, kHeldKeys> kKeys{{
        {GLFW_KEY_W, HeldKey::W},
        {GLFW_KEY_A, HeldKey::A},
        {GLFW_KEY_S, HeldKey::S},
        {GLFW_KEY_D, HeldKey::D},
        {GLFW_KEY_UP, HeldKey::Up},
        {GLFW_KEY_DOWN, HeldKey::Down},
        {GLFW_KEY_LEFT, HeldKey::Left},
        {GLFW_KEY_RIGHT, HeldKey::Right},
        {GLFW_KEY_PAGE_UP, HeldKey::PageUp},
        {GLFW_KEY_PAGE_DOWN, HeldKey::PageDown},
        {GLFW_KEY_HOME, HeldKey::Home},
        {GLFW_KEY_END, HeldKey::End},
    }};
    Hands hands;
    hands.pad = movedPad();
    for (const auto& [key, held] : kKeys)
        if (glfwGetKey(window_.get(), key) == GLFW_PRESS) hands.hold(held);
    if (dragFrom_) {
        const glm::vec2 drag = cursor() - *dragFrom_;
        const auto height = static_cast<float>(glm::max(framebuffer_.load().y, 1));
        hands.drag = glm::vec2(drag.x, -drag.y) / height;
    }
    return hands;
}

// GLFW reports the cursor in screen coordinates, which on a scaled desktop are larger than pixels:
// convert by the ratio of the two sizes.
glm::vec2 WindowContext::cursor() const {
    glm::dvec2 place{};
    glm::ivec2 size{};
    glfwGetCursorPos(window_.get(), &place.x, &place.y);
    glfwGetWindowSize(window_.get(), &size.x, &size.y);
    return {place * glm::dvec2(framebuffer_.load()) / glm::dvec2(glm::max(size, 1))};
}

// Between the rig's place on the desktop and the whole monitor under it. The size of the
// framebuffer may change; channel_show.cpp then fits the picture into it.
void WindowContext::toggleFullscreen() {
    isTakenOff_ = glfwGetWindowMonitor(window_.get()) != nullptr;
    if (isTakenOff_) {
        const glm::ivec2 place = display_.windowPosition;
        glfwSetWindowMonitor(
            window_.get(), nullptr, place.x, place.y, size_.x, size_.y, GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor* monitor = ownMonitor();
    const GLFWvidmode mode = *glfwGetVideoMode(monitor);
    glfwSetWindowMonitor(window_.get(), monitor, 0, 0, mode.width, mode.height, mode.refreshRate);
}

}  // namespace

std::unique_ptr<Context> makeWindowContext(const config::Display& display,
                                           const std::string& title,
                                           glm::ivec2 sizePixels,
                                           bool quadBuffered) {
    return std::make_unique<WindowContext>(display, title, sizePixels, quadBuffered);
}

namespace {

// Converts GLFW's axes, where down is positive and a released trigger is -1.
Pad padOf(const GLFWgamepadstate& state) {
    const auto& axes = state.axes;
    const auto trigger = [&](int axis) { return (axes[axis] + 1) / 2; };
    return {{axes[GLFW_GAMEPAD_AXIS_LEFT_X], -axes[GLFW_GAMEPAD_AXIS_LEFT_Y]},
            {axes[GLFW_GAMEPAD_AXIS_RIGHT_X], -axes[GLFW_GAMEPAD_AXIS_RIGHT_Y]},
            trigger(GLFW_GAMEPAD_AXIS_LEFT_TRIGGER),
            trigger(GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER)};
}

// The largest deflection of any axis, 0 to 1.
float deflectionOf(const Pad& pad) {
    return std::max({std::abs(pad.leftStick.x),
                     std::abs(pad.leftStick.y),
                     std::abs(pad.rightStick.x),
                     std::abs(pad.rightStick.y),
                     pad.leftTrigger,
                     pad.rightTrigger});
}

}  // namespace

Pad movedPad() {
    Pad moved;
    for (int joystick = GLFW_JOYSTICK_1; joystick <= GLFW_JOYSTICK_LAST; ++joystick) {
        GLFWgamepadstate state{};
        if (glfwGetGamepadState(joystick, &state) == GLFW_FALSE) continue;
        const Pad pad = padOf(state);
        if (deflectionOf(pad) > deflectionOf(moved)) moved = pad;
    }
    return moved;
}

}  // namespace aquarama::gl
