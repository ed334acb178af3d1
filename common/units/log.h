// SPDX-License-Identifier: Apache-2.0
// The one exception of the project: thrown while something starts, caught once in each main().
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace aquarama {

// Says what is wrong, where, and what to do, in one line: "config/desk.txtpb:12:3: projector "left"
// ...; move it". Nothing throws inside the frame loop; there a bad packet is an empty optional, and
// is counted.
class Error : public std::runtime_error {
  public:
    explicit Error(const std::string& whatWhereAndWhatToDo)
        : std::runtime_error(whatWhereAndWhatToDo) {}
};

// A line in the log of this process. Formatted here and written there: spdlog's own templates would
// take the compiler six seconds in every source that says something.

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
