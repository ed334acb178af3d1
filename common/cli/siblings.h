// SPDX-License-Identifier: Apache-2.0
// The programs of one installation lie side by side; this finds them and the files that belong to
// them.
#pragma once

#include <filesystem>
#include <string>

namespace aquarama::cli {

// The program `aquarama-NAME` beside the running one. Throws Error where it is missing.
[[nodiscard]] std::filesystem::path siblingProgram(const std::string& name);

}  // namespace aquarama::cli
