// SPDX-License-Identifier: Apache-2.0
// What the command lines of all programs have in common: --help and --version of the program and of
// each command, one line on stderr for an error, the exit status (2 where the command line itself
// is wrong, 1 for every other error), and the signals that end a program.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>

namespace aquarama::cli {

// What a program does once its command line is read; returns the exit status.
using Job = std::function<int()>;

// Reads the command line and does the job, which may rename the program in its errors. An error is
// reported as that of the chosen command: "aquarama study chronicle: ...". Returns the exit status.
[[nodiscard]] int runProgram(CLI::App& app, int count, char** arguments, const Job& job);

// The exit status of a process that was asked to make way for a fresh one: it is started again.
inline constexpr int kStartAgain = 75;

// One line, "PROGRAM: what is wrong": to the supervisor of a show where there is one, else to
// stderr. Line breaks in `what` become spaces; controls and what is no UTF-8 are shown as \xE9.
void sayError(const std::string& program, const std::string& what);

// The environment variable by which a supervisor names, to the processes that it starts, the pipe
// for their errors (a file descriptor).
inline constexpr const char* kErrorPipeVariable = "AQUARAMA_CAUSES";

// Version, commit, build type and libraries of the running program, a line each. The build writes
// its definition for each program (aquarama_version in cmake/Aquarama.cmake).
[[nodiscard]] std::string versionText();

// Version and commit, on one line.
[[nodiscard]] std::string buildText();

// Validators of an option's value; they refuse it in words that name it, what is allowed, and what
// to type where it is meant as a number: 2.5 for "2,5". Both ends of a range are allowed.
[[nodiscard]] CLI::Validator wholeNumber(std::uint64_t least, std::uint64_t most);
[[nodiscard]] CLI::Validator number(double least, double most);
// A text that goes to other machines or into pages: UTF-8, without controls and what nobody sees.
[[nodiscard]] CLI::Validator plainWord();
inline constexpr std::uint64_t kMostSeed = UINT32_MAX;
inline constexpr std::uint64_t kMostShownFrames = 1'000'000'000;  // half a year

// SIGINT, SIGTERM and SIGHUP as a call on a thread of their own, so that a loop that waits for
// something else can be told to end.

// Blocks these signals. Call it before any other thread is made: threads inherit it, and leave the
// signals to the watch. Those that a library has made before do no harm.
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
