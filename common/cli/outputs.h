// SPDX-License-Identifier: Apache-2.0
// What a command writes: lines, files and figures. Files and Python are tested before the command
// works for minutes. Figures and pages are drawn by Python scripts, which lie beside the sources
// that write their data.
#pragma once

#include <filesystem>
#include <string>
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

// Writes a line to standard output at once. Throws Error where it cannot be written.
void say(const std::string& line);

}  // namespace aquarama::cli
