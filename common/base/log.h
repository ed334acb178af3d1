// SPDX-License-Identifier: Apache-2.0
// The one exception of the project, and the log.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
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
    // With the line that is shown.
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

// How much a line of the log matters.
enum class Severity : std::uint8_t { Info, Warning, Error };

// Every line of this process's log goes there as well, from the thread that logs; the listener must
// neither log nor wait. Null: nowhere.
using LogListener = std::function<void(Severity, const std::string& line)>;
void setLogListener(LogListener listener);

// The log of a whole show in one file: an object of JSON in each line, with time (UTC), node,
// frame, severity and text. Lines are written by a thread of their own; where the disk stands still
// the oldest that wait are lost. At 8 MiB the file is named .1 and another begun; five old ones
// stay.
class LogFile {
  public:
    // Makes the folder. Throws Error where the file cannot be written.
    explicit LogFile(const std::filesystem::path& path);
    ~LogFile();
    LogFile(const LogFile&) = delete;
    LogFile& operator=(const LogFile&) = delete;

    // From any thread; does not wait.
    void write(const std::string& node,
               std::uint64_t frame,
               Severity severity,
               const std::string& text);
    // The frame that the master draws, for the lines of its own log.
    std::atomic<std::uint64_t> masterFrame = 0;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aquarama
