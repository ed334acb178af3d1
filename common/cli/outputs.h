// SPDX-License-Identifier: Apache-2.0
// What a command writes, tested before it works for minutes: whether its files can be written, and
// whether there is a Python for its figures. Figures and pages are drawn by Python scripts, which
// lie beside the sources that write their data.
#pragma once

#include <string>
#include <vector>

namespace aquarama::cli {

// Makes the folder where it is missing. Throws Error, which names the option, where no file can be
// written into it. An empty name asks for nothing.
void requireFolder(const std::string& option, const std::string& folder);
// The same for the folder of a file; nor may the file be a folder.
void requireFile(const std::string& option, const std::string& file);

// Throws Error, which says what to install, where no Python has all of the modules. Tried are
// python3 of the PATH and that of the system, or only the one that AQUARAMA_PYTHON names.
void requirePython(const std::vector<std::string>& modules);

// Runs a script ("master/study/draw_study.py") with the first Python that has the modules: that of
// the source tree, or of share/aquarama of an installation, which is nearest above the running
// program. Throws Error where it is missing or fails.
void runPython(const std::vector<std::string>& modules,
               const std::string& script,
               const std::vector<std::string>& arguments);

}  // namespace aquarama::cli
