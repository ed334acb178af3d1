// SPDX-License-Identifier: Apache-2.0
// Child processes that end with their parent, a wait that hears both their deaths and the
// terminal's Ctrl-C, and the errors that they report.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace aquarama::supervisor {

// The file of the running program.
[[nodiscard]] std::filesystem::path ownProgram();
// The program `aquarama-NAME` beside it. Throws Error where it is missing.
[[nodiscard]] std::filesystem::path siblingProgram(const std::string& name);

// A command: an absolute path, and the arguments without the program's own name.
struct Command {
    std::filesystem::path program;
    std::vector<std::string> arguments;
    std::string name = {};  // its argv[0] (cli::runProgram); empty: its path
};

// How a child ended: by itself with a code, or by a signal.
struct Ending {
    pid_t child = 0;
    int exitCode = 0;
    int signal = 0;  // 0 where it ended by itself
    // Whether it ended by itself without an error.
    [[nodiscard]] bool clean() const { return signal == 0 && exitCode == 0; }
};

// The result of one wait: a signal, and the processes that have ended.
struct Heard {
    bool interrupted = false;  // Ctrl-C, SIGTERM or SIGHUP reached us
    std::vector<Ending> endings;
};

// Blocks the signals that waitForChildren() receives; call once, before the first start().
void listenForSignals();

// Starts a child in a process group of its own; it gets SIGTERM when we die. Throws Error where it
// cannot.
[[nodiscard]] pid_t start(const Command& command);

// Waits for the first signal or ended child, at most this long.
[[nodiscard]] Heard waitForChildren(std::chrono::milliseconds atMost);

// Replaces this process by the command. Throws Error where it cannot.
[[noreturn]] void become(const Command& command);

// The errors that the children report (cli::sayError), through a pipe instead of stderr: a show
// that fails then says its first cause in one line. Every child that is started while this exists
// reports to it; whatever else a child writes goes to stderr. One at a time.
class ErrorPipe {
  public:
    // Opens the pipe and closes it. Throws Error where there can be none.
    ErrorPipe();
    ~ErrorPipe();
    ErrorPipe(const ErrorPipe&) = delete;
    ErrorPipe& operator=(const ErrorPipe&) = delete;
    // The lines that came since the last call, the first first.
    [[nodiscard]] std::vector<std::string> heard() const;

  private:
    // The end that does not block, and the end that children inherit.
    int reading_ = -1;
    int writing_ = -1;
};

}  // namespace aquarama::supervisor
