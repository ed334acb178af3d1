// SPDX-License-Identifier: Apache-2.0
// The common parts of all command lines: --help and --version, one line on stderr for an error, the
// exit status (2 for a wrong command line, 1 for every other error), and the signals that end a
// program.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>

namespace aquarama::cli {

// The job of a program after its command line is read; returns the exit status.
using Job = std::function<int()>;

// Reads the command line and runs the job, which may change the program's name in error messages.
// Errors name the chosen command: "aquarama study chronicle: ...". Returns the exit status.
[[nodiscard]] int runProgram(CLI::App& app, int count, char** arguments, const Job& job);

// The exit status of a process that asks to be started again.
inline constexpr int kStartAgain = 75;

// Reports an error as one line, "PROGRAM: what is wrong", to the supervisor of a show or else to
// stderr. Line breaks in `what` become spaces; control characters and invalid UTF-8 become \xE9.
void sayError(const std::string& program, const std::string& what);

// The environment variable with the file descriptor of the pipe for errors, which a supervisor
// gives to its children.
inline constexpr const char* kErrorPipeVariable = "AQUARAMA_CAUSES";

// Version, commit, build type and libraries of the running program, one on each line. The build
// generates its definition for each program (aquarama_version in cmake/Aquarama.cmake).
[[nodiscard]] std::string versionText();

// Version and commit, on one line.
[[nodiscard]] std::string buildText();

// Validators of option values. The refusal names the value, what is allowed and, for numbers, what
// to type: 2.5 for "2,5". Both ends of a range are allowed.
[[nodiscard]] CLI::Validator wholeNumber(std::uint64_t least, std::uint64_t most);
[[nodiscard]] CLI::Validator number(double least, double most);
// Accepts a text for other machines and pages: valid UTF-8 without control or invisible characters.
[[nodiscard]] CLI::Validator plainWord();
inline constexpr std::uint64_t kMostSeed = UINT32_MAX;
inline constexpr int kMostScale = 8;                              // of a scaled panorama
inline constexpr std::uint64_t kMostShownFrames = 1'000'000'000;  // half a year

// SIGINT, SIGTERM and SIGHUP as a call on a separate thread, so that a waiting loop can be stopped.

// Blocks these signals. Call it before any thread is started, since threads inherit the mask and so
// leave the signals to the watch. Earlier threads of libraries do no harm.
void holdSignals();

// Calls `onSignal` for each of these signals, on its own thread, as long as it lives.
class SignalWatch {
  public:
    // Begins to wait for signals, on a thread of its own.
    explicit SignalWatch(std::function<void()> onSignal);

  private:
    std::jthread thread_;
};

}  // namespace aquarama::cli
