// SPDX-License-Identifier: Apache-2.0
// What is in a scene's or a species' file, for `aquarama check`.
#pragma once

#include <string>

#include "common/config/scene.h"

namespace aquarama {

// Several lines. `path`: of the file that it was read from. Throws Error with file:line:column
// where the scene has no room for its fish, or for a mistake in a file of its cast.
[[nodiscard]] std::string inventoryOf(const config::Scene& scene, const std::string& path);
[[nodiscard]] std::string inventoryOf(const config::Species& species, const std::string& path);

}  // namespace aquarama
