// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>
#include <thread>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "common/base/log.h"
#include "render_node/gl/context.h"

namespace aquarama::gl {

namespace {

// Whether a list of extensions, separated by blanks, has exactly this name. A search for a
// substring would also find longer names.
bool lists(const char* extensions, std::string_view name) {
    if (extensions == nullptr) return false;
    std::string_view rest{extensions};
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        if (rest.substr(0, end) == name) return true;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return false;
}

// The devices that EGL enumerates, at most 32, in the storage that is passed; none where EGL cannot
// enumerate.
std::span<EGLDeviceEXT> devices(std::array<EGLDeviceEXT, 32>& storage) {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!lists(extensions, "EGL_EXT_device_base") &&
        !lists(extensions, "EGL_EXT_device_enumeration"))
        return {};
    EGLint count = 0;
    if (eglQueryDevicesEXT(static_cast<EGLint>(storage.size()), storage.data(), &count) ==
        EGL_FALSE)
        return {};
    return std::span{storage}.first(static_cast<std::size_t>(count));
}

bool deviceHas(EGLDeviceEXT device, std::string_view extension) {
    return lists(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), extension);
}

// The device for a rig's `device`; empty means Mesa's surfaceless platform. auto prefers NVIDIA,
// then other hardware, then software. Throws Error where an explicit choice does not exist.
std::optional<EGLDeviceEXT> choose(std::span<EGLDeviceEXT> all, const std::string& wanted) {
    const auto first = [&](auto suits) -> std::optional<EGLDeviceEXT> {
        const auto found = std::ranges::find_if(all, suits);
        return found == all.end() ? std::nullopt : std::optional{*found};
    };
    const auto isNvidia = [](EGLDeviceEXT device) {
        return deviceHas(device, "EGL_NV_device_cuda");
    };
    const auto isSoftware = [](EGLDeviceEXT device) {
        return deviceHas(device, "EGL_MESA_device_software");
    };
    if (wanted == "surfaceless") return std::nullopt;
    if (wanted == "mesa") return first(isSoftware);
    if (wanted == "auto") {
        if (const auto nvidia = first(isNvidia)) return nvidia;
        if (const auto hardware = first([&](EGLDeviceEXT device) { return !isSoftware(device); }))
            return hardware;
        return first(isSoftware);
    }
    if (wanted == "nvidia") {
        if (const auto nvidia = first(isNvidia)) return nvidia;
        throw Error(
            "device \"nvidia\": no NVIDIA device is offered by EGL; install its driver or use "
            "device \"auto\"");
    }
    if (wanted.starts_with("device:")) {
        const std::string digits = wanted.substr(std::strlen("device:"));
        const bool numeric =
            !digits.empty() && digits.size() < 4 &&
            std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
        if (numeric && std::stoul(digits) < all.size()) return all[std::stoul(digits)];
        throw Error("device \"" + wanted + "\": EGL offers " + std::to_string(all.size()) +
                    " devices, numbered from 0");
    }
    throw Error("device \"" + wanted +
                "\" is unknown; use auto, nvidia, mesa, surfaceless or device:N");
}

// Throws Error unless EGL has one of the two platforms that need no display.
void requireEgl() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!lists(extensions, "EGL_EXT_platform_device") &&
        !lists(extensions, "EGL_MESA_platform_surfaceless"))
        throw Error("EGL offers no device without a display; install a driver (libegl-mesa0)");
}

// An OpenGL 4.5 core context. With toldOfReset, glGetGraphicsResetStatus() will report a reset of
// the graphics card; some drivers refuse such a context.
EGLContext makeContext(EGLDisplay display, bool toldOfReset) {
    const std::array attributes{
        EGL_CONTEXT_MAJOR_VERSION,
        4,
        EGL_CONTEXT_MINOR_VERSION,
        5,
        EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
        toldOfReset ? EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY : EGL_NONE,
        EGL_LOSE_CONTEXT_ON_RESET,
        EGL_NONE};
    return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
}

// Owns a context of EGL that is never used with a surface.
class OffscreenWorkspace final : public Workspace {
  public:
    explicit OffscreenWorkspace(EGLDisplay display) : display_{display} {
        eglBindAPI(EGL_OPENGL_API);  // of the thread
        context_ = makeContext(display_, /*toldOfReset=*/true);
        if (context_ == EGL_NO_CONTEXT) context_ = makeContext(display_, /*toldOfReset=*/false);
    }
    ~OffscreenWorkspace() override {
        if (eglGetCurrentContext() == context_) release();
        eglDestroyContext(display_, context_);
    }
    OffscreenWorkspace(const OffscreenWorkspace&) = delete;
    OffscreenWorkspace& operator=(const OffscreenWorkspace&) = delete;

    [[nodiscard]] bool exists() const { return context_ != EGL_NO_CONTEXT; }
    void makeCurrent() override {
        eglBindAPI(EGL_OPENGL_API);
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
            throw Error(
                "EGL refuses to make the context current without a surface; update the driver");
        }
    }
    void release() override {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }

  private:
    EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
};

// A context without a surface. Everything is drawn into framebuffer objects; there is no input.
class OffscreenContext final : public Context {
  public:
    OffscreenContext(const std::string& device, glm::ivec2 sizePixels) : sizePixels_{sizePixels} {
        assert(sizePixels_.x > 0);
        assert(sizePixels_.y > 0);
        std::array<EGLDeviceEXT, 32> storage{};
        requireEgl();
        const auto chosen = choose(devices(storage), device);
        display_ = chosen ? eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, *chosen, nullptr)
                          : eglGetPlatformDisplayEXT(
                                EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) == EGL_FALSE) {
            throw Error("device \"" + device +
                        "\": EGL does not start; install libegl1 and a driver (libgl1-mesa-dri)");
        }
        own_.emplace(display_);
        if (!own_->exists()) {
            throw Error(
                "device \"" + device +
                "\": no OpenGL 4.5 core context; update its driver or choose another device");
        }
        makeCurrent();
        requireDriver("device \"" + device + "\"");
    }
    // The display is not terminated: EGL shares it among all contexts of the process.

    [[nodiscard]] std::unique_ptr<Workspace> makeWorkspace() override {
        auto workspace = std::make_unique<OffscreenWorkspace>(display_);
        if (!workspace->exists()) throw Error("EGL gives no more contexts; restart the node");
        return workspace;
    }
    void makeCurrent() override { own_->makeCurrent(); }
    void release() override { own_->release(); }
    void swap() override {}
    [[nodiscard]] glm::ivec2 framebufferPixels() const override { return sizePixels_; }
    [[nodiscard]] bool hasWindow() const override { return false; }
    [[nodiscard]] std::string description() const override {
        return rendererAndVersion() + ", EGL without display";
    }
    [[nodiscard]] std::optional<std::string> loss() const override { return lossOfContext(); }
    void pumpEvents(std::chrono::milliseconds atMost) override {
        // There are no events: wait out the time, so that the main loop does not spin.
        std::this_thread::sleep_for(atMost);
    }
    [[nodiscard]] std::optional<char> nextKey() override { return std::nullopt; }
    [[nodiscard]] std::optional<glm::vec2> nextClick() override { return std::nullopt; }
    [[nodiscard]] std::optional<glm::vec2> pointer() const override { return std::nullopt; }
    [[nodiscard]] Hands hands() const override { return {}; }

  private:
    glm::ivec2 sizePixels_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    std::optional<OffscreenWorkspace> own_;
};

}  // namespace

std::unique_ptr<Context> makeOffscreenContext(const std::string& device, glm::ivec2 sizePixels) {
    return std::make_unique<OffscreenContext>(device, sizePixels);
}

namespace {

// A limit of the driver, and the least value that our shaders need.
struct Need {
    const char* what;
    GLenum limit;
    int least;
};

// Limits for which OpenGL 4.5 guarantees less than we need, some of them 0. When a shader needs
// more, raise its line here.
constexpr std::array kNeeds{
    Need{"storage blocks in vertex shaders", GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, 4},
    Need{"storage blocks in compute shaders", GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, 8},
    Need{"texture units", GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, 32},
    Need{"invocations in a work group", GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, 128},
    Need{"bytes of shared memory", GL_MAX_COMPUTE_SHARED_MEMORY_SIZE, 16384},
    Need{"pixels along a texture", GL_MAX_TEXTURE_SIZE, 8192},
};

// A string of the driver; it returns null without a current context.
std::string driverText(GLenum name) {
    const auto* text = reinterpret_cast<const char*>(glGetString(name));
    return text != nullptr ? text : "unknown";
}

int limitOfDriver(unsigned limit) {
    GLint value = 0;
    glGetIntegerv(limit, &value);
    return value;
}

}  // namespace

void requireDriver(const std::string& where) {
    if (epoxy_gl_version() < 45)
        throw Error(where + ": OpenGL 4.5 is needed, " + rendererAndVersion() +
                    " has less; update its driver or choose another device");
    if (const auto lack = lackOf(limitOfDriver))
        throw Error(where + ": " + rendererAndVersion() + " lacks what is needed: " + *lack +
                    "; update its driver or choose another device");
}

std::optional<std::string> lackOf(const std::function<int(unsigned limit)>& limitOf) {
    assert(limitOf != nullptr);
    for (const Need& need : kNeeds)
        if (const int has = limitOf(need.limit); has < need.least)
            return std::to_string(need.least) + " " + need.what + ", it has " + std::to_string(has);
    return std::nullopt;
}

std::string rendererAndVersion() {
    return driverText(GL_RENDERER) + ", OpenGL " + driverText(GL_VERSION);
}

std::optional<std::string> lossOfContext() {
    switch (glGetGraphicsResetStatus()) {
        case GL_NO_ERROR:
            return std::nullopt;
        case GL_GUILTY_CONTEXT_RESET:
            return "our own work made the graphics card stop";
        case GL_INNOCENT_CONTEXT_RESET:
            return "another program made the graphics card stop";
        default:
            return "the graphics card stopped";
    }
}

}  // namespace aquarama::gl
