// SPDX-License-Identifier: Apache-2.0
// What the current context turned out to be; a driver may give less than it was asked for, and may
// lose what it gave.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace aquarama::context {

// Throws Error, naming `where` and the driver, unless the current context is OpenGL 4.5 or later
// with all that our shaders take.
void requireDriver(const std::string& where);

// What is lacking of what we need, as "8 storage blocks in vertex shaders, it has 0"; nothing where
// nothing is. `limitOf` answers as glGetIntegerv does.
[[nodiscard]] std::optional<std::string> lackOf(const std::function<int(unsigned limit)>& limitOf);

[[nodiscard]] std::string rendererAndVersion();

// Why the current context is lost; nothing while it is not.
[[nodiscard]] std::optional<std::string> lossOfContext();

}  // namespace aquarama::context
