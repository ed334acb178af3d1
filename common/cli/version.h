// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace aquarama::cli {

// Version, commit, build type and libraries of the running program, a line each. The build writes
// it for each program (aquarama_version in cmake/Aquarama.cmake).
[[nodiscard]] std::string versionText();

}  // namespace aquarama::cli
