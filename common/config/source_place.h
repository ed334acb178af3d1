// SPDX-License-Identifier: Apache-2.0
// Where something stands in a file.
#pragma once

#include <string>

namespace aquarama::config {

// Counted from 1, for messages; 0 when built in code.
struct SourcePlace {
    int line = 0;
    int column = 0;
};

// "file:line:column: why"
[[nodiscard]] inline std::string placed(const std::string& source,
                                        SourcePlace place,
                                        const std::string& why) {
    return source + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) + ": " +
           why;
}

}  // namespace aquarama::config
