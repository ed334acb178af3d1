// SPDX-License-Identifier: Apache-2.0
// Checks before long work that outputs can be written and that Python is available; and progress
// lines. Python scripts draw figures and pages; each lies beside the sources that write its data.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace aquarama::cli {

// Creates the folder where it is missing. Throws Error, which names the option, where no file can
// be written into it. An empty name is ignored.
void requireFolder(const std::string& option, const std::string& folder);
// The same for a file, which is not changed. A FIFO or device is not opened.
void requireFile(const std::string& option, const std::string& file);

// The path of a file that comes with the programs ("config/scenes/reef.txtpb"): that of the source
// tree, or of share/aquarama of an installation, which is nearest above the running program. Throws
// Error where there is none.
[[nodiscard]] std::string findData(const std::string& file);

// Throws Error, which says what to install, where no Python has all of the modules. It tries
// python3 of the PATH and of the system, or only the one that AQUARAMA_PYTHON names.
void requirePython(const std::vector<std::string>& modules);

// Runs a script ("master/study/draw_study.py"), found as findData() does, with the first Python
// that has the modules. What it draws goes into `folder`, by the rules of all outputs: it writes
// into a temporary folder, AQUARAMA_DRAWN. Throws Error where it is missing or fails.
void runPython(const std::vector<std::string>& modules,
               const std::string& script,
               const std::vector<std::string>& arguments,
               const std::filesystem::path& folder);

// Shows the progress of long work on standard output: in one line of a terminal that is rewritten,
// or in a log line every ten seconds.
class Progress {
  public:
    // The name, as in "clip: picture", and the number of steps; 0: unknown.
    Progress(std::string what, std::uint64_t ofAll) : what_{std::move(what)}, ofAll_{ofAll} {}
    void show(std::uint64_t done);
    // Clears the terminal's line.
    void end() const;

  private:
    using Clock = std::chrono::steady_clock;
    std::string what_;
    std::uint64_t ofAll_;
    bool terminal_ = isTerminal();
    Clock::time_point begun_ = Clock::now();
    Clock::time_point shown_ = begun_;

    static bool isTerminal();
};

}  // namespace aquarama::cli
