// SPDX-License-Identifier: Apache-2.0
// The one exception of the project, and the log.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace aquarama {

// Thrown while something starts, caught once in each main(). Says in one line what is wrong, where,
// and what to do: "config/desk.txtpb:12:3: projector "left" ...; move it". Nothing throws inside
// the frame loop: there a bad packet becomes an empty optional, and is counted.
class Error : public std::runtime_error {
  public:
    explicit Error(const std::string& whatWhereAndWhatToDo)
        : std::runtime_error(whatWhereAndWhatToDo) {}
};

// A line in the log of this process; may be called from any thread. The templates below format the
// line, these functions write it: spdlog's own templates would add six seconds to the compilation
// of every source that logs.
void writeInfo(const std::string& line);
void writeWarning(const std::string& line);
void writeError(const std::string& line);

// What happens: logInfo("node {} has left", name).
template <typename... Values>
void logInfo(fmt::format_string<Values...> format, Values&&... values) {
    writeInfo(fmt::format(format, std::forward<Values>(values)...));
}

// What an operator should look at; the show goes on.
template <typename... Values>
void logWarning(fmt::format_string<Values...> format, Values&&... values) {
    writeWarning(fmt::format(format, std::forward<Values>(values)...));
}

// What is lost or stops the program.
template <typename... Values>
void logError(fmt::format_string<Values...> format, Values&&... values) {
    writeError(fmt::format(format, std::forward<Values>(values)...));
}

}  // namespace aquarama
