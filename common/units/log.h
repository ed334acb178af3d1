// SPDX-License-Identifier: Apache-2.0
// A line in the log of this process. Formatted here and written there: spdlog's own templates would
// take the compiler six seconds in every source that says something.
#pragma once

#include <string>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace aquarama {

void writeInfo(const std::string& line);
void writeWarning(const std::string& line);
void writeError(const std::string& line);

// logInfo("node {} has left", name): what happens.
template <typename... Values>
void logInfo(fmt::format_string<Values...> format, Values&&... values) {
    writeInfo(fmt::format(format, std::forward<Values>(values)...));
}

// What somebody should look at; the show goes on.
template <typename... Values>
void logWarning(fmt::format_string<Values...> format, Values&&... values) {
    writeWarning(fmt::format(format, std::forward<Values>(values)...));
}

// What is lost.
template <typename... Values>
void logError(fmt::format_string<Values...> format, Values&&... values) {
    writeError(fmt::format(format, std::forward<Values>(values)...));
}

}  // namespace aquarama
