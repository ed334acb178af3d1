// SPDX-License-Identifier: Apache-2.0
// What the command lines of all programs have in common: --version, one line on stderr for whatever
// is wrong, and the exit status: 2 where the command line itself is wrong, 1 for everything else.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace aquarama::cli {

// What a program does once its command line is read; returns the exit status.
using Job = std::function<int()>;

// Reads the command line and does the job, which may rename the program in its errors. Returns the
// exit status.
[[nodiscard]] int runProgram(CLI::App& app, int count, char** arguments, const Job& job);

// One line, "PROGRAM: what is wrong": to the supervisor where one waits for it, else to stderr.
void sayError(const std::string& program, const std::string& what);

// Refuse an option's value in words that name it and what is allowed.
[[nodiscard]] CLI::Validator wholeNumber(std::uint64_t least, std::uint64_t most);
[[nodiscard]] CLI::Validator number(double least, double most);
inline constexpr std::uint64_t kMostSeed = UINT32_MAX;
inline constexpr std::uint64_t kMostShownFrames = 1'000'000'000;  // half a year

}  // namespace aquarama::cli
