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

// An error of the user: one line that says what is wrong, where, and what to do:
// "config/desk.txtpb:12:3: projector "left" ...; move it". Thrown during start and caught once in
// each main(). The frame loop never throws: there a bad packet becomes an empty optional and is
// counted.
class Error : public std::runtime_error {
  public:
    // With the line that is shown.
    explicit Error(const std::string& whatWhereAndWhatToDo)
        : std::runtime_error(whatWhereAndWhatToDo) {}
};

// Write a line to the log of this process, from any thread. The templates below format the line.
// spdlog's own templates would add six seconds to the compilation of every source that logs.
void writeInfo(const std::string& line);
void writeWarning(const std::string& line);
void writeError(const std::string& line);

// Logs an event: logInfo("node {} has left", name).
template <typename... Values>
void logInfo(fmt::format_string<Values...> format, Values&&... values) {
    writeInfo(fmt::format(format, std::forward<Values>(values)...));
}

// Logs a problem for the operator; the show continues.
template <typename... Values>
void logWarning(fmt::format_string<Values...> format, Values&&... values) {
    writeWarning(fmt::format(format, std::forward<Values>(values)...));
}

// Logs a loss, or what stops the program.
template <typename... Values>
void logError(fmt::format_string<Values...> format, Values&&... values) {
    writeError(fmt::format(format, std::forward<Values>(values)...));
}

// The importance of a log line.
enum class Severity : std::uint8_t { Info, Warning, Error };

// Sets a function that receives every line of this process's log, on the thread that logs. It must
// neither log nor wait. Null: none.
using LogListener = std::function<void(Severity, const std::string& line)>;
void setLogListener(LogListener listener);

// The log file of a whole show: one JSON object a line, with time (UTC), node, frame, severity and
// text. A thread of its own writes; if the disk blocks, the oldest waiting lines are lost. At 8 MiB
// the file is renamed to .1 and a new one begins; five old files are kept.
class LogFile {
  public:
    // Makes the folder. Throws Error where the file cannot be written.
    explicit LogFile(const std::filesystem::path& path);
    ~LogFile();
    LogFile(const LogFile&) = delete;
    LogFile& operator=(const LogFile&) = delete;

    // Adds a line. Any thread; does not wait.
    void write(const std::string& node,
               std::uint64_t frame,
               Severity severity,
               const std::string& text);
    // Sets the present frame, for the master's own lines.
    std::atomic<std::uint64_t> masterFrame = 0;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aquarama
