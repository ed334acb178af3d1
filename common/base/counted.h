// SPDX-License-Identifier: Apache-2.0
// Numbers of things in sentences: "1 node", "3 nodes".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace aquarama {

// The count and the noun, whose plural must end in s.
[[nodiscard]] inline std::string counted(std::uint64_t count, std::string_view noun) {
    return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

}  // namespace aquarama
