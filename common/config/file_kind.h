// SPDX-License-Identifier: Apache-2.0
// Which of our text files one is: all end in .txtpb, and what they hold tells them apart.
#pragma once

#include <cstdint>
#include <string>

namespace aquarama::config {

enum class FileKind : std::uint8_t { Rig, Scene, Species };

// The schema that has the most of the text's outermost fields, so that one with a mistake is still
// known; a rig where none has any.
[[nodiscard]] FileKind fileKindOf(const std::string& text);
[[nodiscard]] FileKind fileKindAt(const std::string& path);

}  // namespace aquarama::config
