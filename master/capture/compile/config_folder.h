// SPDX-License-Identifier: Apache-2.0
// Where the species files are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace aquarama::capture {

// The folder `config` of the source tree, or share/aquarama/config of an installation, that is
// nearest above the running program. Throws Error where there is none.
[[nodiscard]] std::filesystem::path findConfigFolder();

// Files of the species that are asked for by name or by path; all there are when none is.
[[nodiscard]] std::vector<std::filesystem::path> speciesFiles(
    const std::vector<std::string>& namesOrFiles, const std::filesystem::path& configFolder);

}  // namespace aquarama::capture
