// SPDX-License-Identifier: Apache-2.0
// What is in a scene's or a species' file, for `aquarama check`.
#pragma once

#include <string>

namespace aquarama {

// Several lines; each throws Error with file:line:column for a mistake in the file, or in one that
// it names.
[[nodiscard]] std::string inventoryOfScene(const std::string& path);
[[nodiscard]] std::string inventoryOfSpecies(const std::string& path);

}  // namespace aquarama
