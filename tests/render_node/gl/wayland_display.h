// SPDX-License-Identifier: Apache-2.0
// A Wayland desktop without a screen, for tests of windows: a compositor of its own on a virtual
// display of its own, ended with the test.
#pragma once

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/render_node/gl/virtual_display.h"

namespace aquarama::gl {

// NOLINTBEGIN(concurrency-mt-unsafe): tests change the environment before they make threads.
class WaylandDisplay {
  public:
    // Nothing where weston is not installed, where it does not start, or where GLFW knows X11
    // alone.
    static std::unique_ptr<WaylandDisplay> start() {
#ifdef GLFW_PLATFORM
        if (std::system("command -v weston > /dev/null") != 0) return nullptr;
        auto screen = VirtualDisplay::start();
        if (!screen) return nullptr;
        std::unique_ptr<WaylandDisplay> display(new WaylandDisplay(std::move(screen)));
        return display->listens() ? std::move(display) : nullptr;
#else
        return nullptr;
#endif
    }
    ~WaylandDisplay() {
        kill(server_, SIGTERM);
        waitpid(server_, nullptr, 0);
        unsetenv("WAYLAND_DISPLAY");
        std::filesystem::remove_all(folder_);
    }
    WaylandDisplay(const WaylandDisplay&) = delete;
    WaylandDisplay& operator=(const WaylandDisplay&) = delete;

  private:
    explicit WaylandDisplay(std::unique_ptr<VirtualDisplay> screen) : screen_(std::move(screen)) {
        std::string folder = std::filesystem::temp_directory_path() / "aquarama-wayland-XXXXXX";
        folder_ = mkdtemp(folder.data());
        setenv("XDG_RUNTIME_DIR", folder.c_str(), 1);
        server_ = fork();
        if (server_ != 0) {
            setenv("WAYLAND_DISPLAY", kSocket, 1);
            unsetenv("DISPLAY");
            return;
        }
        (void)!freopen("/dev/null", "w", stdout);
        (void)!freopen("/dev/null", "w", stderr);
        execlp("weston",
               "weston",
               "--backend=x11",  // has a keyboard and a mouse; without a seat GLFW 3.4 crashes
               "--renderer=pixman",
               "--no-config",
               "--idle-time=0",
               (std::string("--socket=") + kSocket).c_str(),
               static_cast<char*>(nullptr));
        _exit(127);
    }

    // Within ten seconds.
    [[nodiscard]] bool listens() const {
        for (int tries = 0; tries < 1000; ++tries) {
            if (std::filesystem::exists(folder_ / kSocket)) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }

    static constexpr const char* kSocket = "aquarama";
    std::unique_ptr<VirtualDisplay> screen_;
    std::filesystem::path folder_;
    pid_t server_ = 0;
};
// NOLINTEND(concurrency-mt-unsafe)

}  // namespace aquarama::gl
