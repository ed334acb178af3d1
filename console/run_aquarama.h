// SPDX-License-Identifier: Apache-2.0
// Runs a command of `aquarama`, which lies beside this program, for what the console shows or does.
#pragma once

#include <string>
#include <vector>

namespace aquarama::console {

// What a program says on its standard output, and how it ended.
struct Said {
    std::string text;
    int status = -1;  // -1: it could not be started, or did not end by itself
};

// Runs it to its end, or ends it after a minute. `withErrors`: the text has its errors, too.
[[nodiscard]] Said runAquarama(std::vector<std::string> arguments, bool withErrors);

// What it said last, as the reason of a failure; otherwise, where it said nothing.
[[nodiscard]] std::string lastLineOf(const Said& said, const char* otherwise);

// The lines of a text without their ends; the last may have none.
[[nodiscard]] std::vector<std::string> linesOf(const std::string& text);

}  // namespace aquarama::console
