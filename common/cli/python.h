// SPDX-License-Identifier: Apache-2.0
// Figures and pages are made by Python scripts, which lie beside the sources that write their data.
#pragma once

#include <string>
#include <vector>

namespace aquarama::cli {

// Throws Error, which says what to install, where no Python has all of the modules: asked before a
// command works for minutes. Looked at are python3 of the PATH and that of the system, or only the
// one that AQUARAMA_PYTHON names.
void requirePython(const std::vector<std::string>& modules);

// Runs "master/study/draw_study.py" of the source tree, or of share/aquarama of an installation,
// that is nearest above the running program, with the first Python that has the modules. Throws
// Error where it is missing or fails.
void runPython(const std::vector<std::string>& modules,
               const std::string& script,
               const std::vector<std::string>& arguments);

}  // namespace aquarama::cli
