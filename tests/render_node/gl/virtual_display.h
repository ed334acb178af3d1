// SPDX-License-Identifier: Apache-2.0
// A display without a screen, for tests of windows: an X server of its own, ended with the test.
#pragma once

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace aquarama::gl {

// NOLINTBEGIN(concurrency-mt-unsafe): tests change the environment before they make threads.
class VirtualDisplay {
  public:
    static constexpr glm::ivec2 kSize{800, 600};

    // Nothing where Xvfb, xdotool or xwd is not installed.
    static std::unique_ptr<VirtualDisplay> start() {
        for (const char* program : {"Xvfb", "xdotool", "xwd"})
            if (std::system(("command -v " + std::string(program) + " > /dev/null").c_str()) != 0)
                return nullptr;
        return std::unique_ptr<VirtualDisplay>(new VirtualDisplay);
    }
    ~VirtualDisplay() {
        kill(server_, SIGTERM);
        waitpid(server_, nullptr, 0);
        unsetenv("DISPLAY");
    }
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;

    // Presses a key in the window of this title, as a keyboard would.
    static void press(const std::string& title, const std::string& key) {
        const std::string command =
            "xdotool search --name '^" + title + "$' windowfocus --sync key " + key;
        if (std::system(command.c_str()) != 0) std::fputs("xdotool failed\n", stderr);
    }

    // Whatever xdotool's words say, with the keyboard in the window of this title.
    static void hold(const std::string& title, const std::string& words) {
        const std::string command =
            "xdotool search --name '^" + title + "$' windowfocus --sync " + words;
        if (std::system(command.c_str()) != 0) std::fputs("xdotool failed\n", stderr);
    }

    // Moves the mouse to a place of the display, and presses a button there where one is given.
    static void point(glm::ivec2 place, const std::string& button = "") {
        const std::string command = "xdotool mousemove --sync " + std::to_string(place.x) + " " +
                                    std::to_string(place.y) +
                                    (button.empty() ? "" : " click " + button);
        if (std::system(command.c_str()) != 0) std::fputs("xdotool failed\n", stderr);
    }

    // Red, green and blue of every pixel of the display, top row first.
    static std::vector<std::uint8_t> screenshot() {
        const std::vector<std::uint8_t> dump = outputOf("xwd -root -silent");
        const auto field = [&](std::size_t i) {  // of the header: 32 bits, big-endian
            return std::uint32_t{dump[4 * i]} << 24U | std::uint32_t{dump[4 * i + 1]} << 16U |
                   std::uint32_t{dump[4 * i + 2]} << 8U | dump[4 * i + 3];
        };
        const std::size_t pixels = field(0) + std::size_t{field(19)} * 12;
        // Where windows differ in visual from the root, xwd packs 3 bytes a pixel instead of 4.
        const std::size_t pixelBytes = field(11) / 8;
        const std::size_t rowBytes = field(12);
        std::vector<std::uint8_t> rgb;
        for (std::size_t y = 0; y < kSize.y; ++y)
            for (std::size_t x = 0; x < kSize.x; ++x)
                for (const std::size_t colour : {2U, 1U, 0U})
                    rgb.push_back(dump[pixels + y * rowBytes + pixelBytes * x + colour]);
        return rgb;
    }

  private:
    VirtualDisplay() {
        std::array<int, 2> number{};
        if (pipe(number.data()) != 0) return;
        const std::string size = std::to_string(kSize.x) + "x" + std::to_string(kSize.y) + "x24";
        const std::string descriptor = std::to_string(number[1]);
        server_ = fork();
        if (server_ == 0) {
            (void)!freopen("/dev/null", "w", stderr);
            execlp("Xvfb",
                   "Xvfb",
                   "-displayfd",
                   descriptor.c_str(),
                   "-screen",
                   "0",
                   size.c_str(),
                   "-noreset",  // by default a server starts anew, and is away a moment, when its
                                // last client goes
                   "-nolisten",
                   "tcp",
                   static_cast<char*>(nullptr));
            _exit(127);
        }
        close(number[1]);
        std::string name = ":";
        for (char digit = 0; read(number[0], &digit, 1) == 1 && digit != '\n';) name += digit;
        close(number[0]);
        setenv("DISPLAY", name.c_str(), 1);
    }

    static std::vector<std::uint8_t> outputOf(const std::string& command) {
        std::vector<std::uint8_t> output;
        std::FILE* program = popen(command.c_str(), "r");
        for (int byte = 0; (byte = std::fgetc(program)) != EOF;)
            output.push_back(static_cast<std::uint8_t>(byte));
        pclose(program);
        return output;
    }

    pid_t server_ = 0;
};
// NOLINTEND(concurrency-mt-unsafe)

}  // namespace aquarama::gl
