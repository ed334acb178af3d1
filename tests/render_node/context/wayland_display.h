// SPDX-License-Identifier: Apache-2.0
// A Wayland desktop without a screen, for tests of windows: a compositor of its own, ended with the
// test.
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

namespace aquarama {

// NOLINTBEGIN(concurrency-mt-unsafe): tests change the environment before they make threads.
class WaylandDisplay {
  public:
    // Nothing where weston is not installed, where it does not start, or where GLFW knows X11
    // alone.
    static std::unique_ptr<WaylandDisplay> start() {
#ifdef GLFW_PLATFORM
        if (std::system("command -v weston > /dev/null") != 0) return nullptr;
        std::unique_ptr<WaylandDisplay> display(new WaylandDisplay);
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
    WaylandDisplay() {
        std::string folder = std::filesystem::temp_directory_path() / "aquarama-wayland-XXXXXX";
        folder_ = mkdtemp(folder.data());
        setenv("XDG_RUNTIME_DIR", folder.c_str(), 1);
        setenv("WAYLAND_DISPLAY", kSocket, 1);
        unsetenv("DISPLAY");
        server_ = fork();
        if (server_ != 0) return;
        unsetenv("WAYLAND_DISPLAY");
        (void)!freopen("/dev/null", "w", stderr);
        execlp("weston",
               "weston",
               "--backend=headless",
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
    std::filesystem::path folder_;
    pid_t server_ = 0;
};
// NOLINTEND(concurrency-mt-unsafe)

}  // namespace aquarama
