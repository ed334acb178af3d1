// SPDX-License-Identifier: Apache-2.0
// Pictures to and from PNG files.
#pragma once

#include <string>

#include "common/wall/picture.h"

namespace aquarama::wall {

// Throws Error when the file is no readable picture of 16384 pixels or fewer each way, 64
// million in all. Grey and
// palettes come as red green blue, transparency is dropped.
[[nodiscard]] Picture readPng(const std::string& path);
void writePng(const std::string& path, const Picture& picture);

}  // namespace aquarama::wall
