// SPDX-License-Identifier: Apache-2.0
// Pictures to and from PNG files.
#pragma once

#include <string>

#include "common/wall/picture.h"

namespace aquarama::wall {

// Grey and palettes are read as red green blue, transparency is dropped; 16 bits stay 16, fewer
// become 8. Throws Error when the file is not a readable picture of at most 16384 pixels each way
// and 64 million in all.
[[nodiscard]] Picture readPng(const std::string& path);
// 8 or 16 bits, as the picture has. Throws Error when the file cannot be written.
void writePng(const std::string& path, const Picture& picture);

}  // namespace aquarama::wall
