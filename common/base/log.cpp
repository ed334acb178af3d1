// SPDX-License-Identifier: Apache-2.0
#include "common/base/log.h"

#include <array>
#include <chrono>
#include <mutex>

#include <nlohmann/json.hpp>
#include <spdlog/async.h>
#include <spdlog/fmt/chrono.h>
#include <spdlog/sinks/rotating_file_sink.h>
#include <spdlog/spdlog.h>

#include "common/base/characters.h"
#include "common/base/files.h"

namespace aquarama {
namespace {

std::mutex listenerMutex;
LogListener listener;

void tellListener(Severity severity, const std::string& line) {
    const std::lock_guard lock(listenerMutex);
    if (listener) listener(severity, line);
}

// Logs a line without control characters and invalid UTF-8. It may contain foreign names, and it
// goes to terminals, the log file and pages.
void write(spdlog::level::level_enum level, Severity severity, const std::string& line) {
    const std::string shown = legible(line);
    spdlog::log(level, shown);
    tellListener(severity, shown);
}

}  // namespace

void writeInfo(const std::string& line) {
    write(spdlog::level::info, Severity::Info, line);
}

void writeWarning(const std::string& line) {
    write(spdlog::level::warn, Severity::Warning, line);
}

void writeError(const std::string& line) {
    write(spdlog::level::err, Severity::Error, line);
}

void setLogListener(LogListener next) {
    // The last listener is destroyed without the lock, since that may end a thread that logs.
    const std::lock_guard lock(listenerMutex);
    listener.swap(next);
}

// The logger, and the thread that writes its queue. The thread is destroyed first.
struct LogFile::Impl {
    std::shared_ptr<spdlog::async_logger> logger;
    std::shared_ptr<spdlog::details::thread_pool> thread;
};

LogFile::LogFile(const std::filesystem::path& path) : impl_(std::make_unique<Impl>()) {
    constexpr std::size_t kMostBytes = std::size_t{8} << 20U;
    constexpr std::size_t kOldFiles = 5;
    constexpr std::size_t kWaitingLines = 1024;
    try {
        std::filesystem::create_directories(path.parent_path());
        auto sink = std::make_shared<spdlog::sinks::rotating_file_sink_mt>(
            path.string(), kMostBytes, kOldFiles);
        impl_->thread = std::make_shared<spdlog::details::thread_pool>(kWaitingLines, 1);
        impl_->logger = std::make_shared<spdlog::async_logger>(
            "show", sink, impl_->thread, spdlog::async_overflow_policy::overrun_oldest);
    } catch (const std::exception& problem) {
        throw Error(path.string() + ": the log of the show cannot be written (" + problem.what() +
                    "); make its folder writable");
    }
    impl_->logger->set_pattern("%v");
    impl_->logger->set_error_handler([path](const std::string& problem) {
        warnOnceOf(
            path, path.string() + ": " + problem, "lines of the log are lost; make room there");
    });
    impl_->logger->flush_on(spdlog::level::info);
}

LogFile::~LogFile() = default;

void LogFile::write(const std::string& node,
                    std::uint64_t frame,
                    Severity severity,
                    const std::string& text) {
    constexpr std::array kNames{"info", "warning", "error"};
    const auto now =
        std::chrono::floor<std::chrono::milliseconds>(std::chrono::system_clock::now());
    const auto milliseconds = now.time_since_epoch().count() % 1000;
    const nlohmann::ordered_json line{
        {"time",
         fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(now)),
                     milliseconds)},
        {"node", node},
        {"frame", frame},
        {"severity", kNames.at(static_cast<std::size_t>(severity))},
        {"text", text}};
    impl_->logger->info(
        line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace aquarama
