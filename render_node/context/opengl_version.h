// SPDX-License-Identifier: Apache-2.0
// What the current context turned out to be; a driver may give less than it was asked for.
#pragma once

#include <string>

namespace aquarama {

// Throws Error, naming `where`, unless the current context is OpenGL 4.5 or later.
void requireOpenGl45(const std::string& where);
[[nodiscard]] std::string rendererAndVersion();

}  // namespace aquarama
