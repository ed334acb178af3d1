// SPDX-License-Identifier: Apache-2.0
// Child processes that end with their parent, and a wait that hears both their deaths and the
// terminal's Ctrl-C.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace aquarama::cli {

struct Command {
    std::filesystem::path program;
    std::vector<std::string> arguments;
};

// How a child ended: by itself with a code, or by a signal.
struct Ending {
    pid_t child = 0;
    int exitCode = 0;
    int signal = 0;  // 0 where it ended by itself
    [[nodiscard]] bool clean() const { return signal == 0 && exitCode == 0; }
};

// What a wait heard.
struct Heard {
    bool interrupted = false;  // Ctrl-C, SIGTERM or SIGHUP reached us
    std::vector<Ending> endings;
};

// Holds back the signals that waitForChildren() listens to; call once, before the first start().
void listenForSignals();

// Starts a child in a process group of its own; it gets SIGTERM when we die. Throws Error where it
// cannot.
[[nodiscard]] pid_t start(const Command& command);

[[nodiscard]] Heard waitForChildren(std::chrono::milliseconds atMost);

// Replaces this process by the command. Throws Error where it cannot.
[[noreturn]] void become(const Command& command);

}  // namespace aquarama::cli
