// SPDX-License-Identifier: Apache-2.0
#include "common/cli/command_line.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <optional>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>

#include <signal.h>
#include <unistd.h>

#include "common/base/characters.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/output_file.h"

namespace aquarama::cli {

namespace {

constexpr int kFailed = 1;
constexpr int kUsage = 2;

// The program's name with the chosen commands: "aquarama study chronicle".
std::string commandOf(const CLI::App& app) {
    std::string name = app.get_name();
    for (const CLI::App* command : app.get_subcommands())
        if (!command->get_name().empty()) name += " " + commandOf(*command);  // else a group
    return name;
}

// Takes over the name in argv[0] where `aquarama` has started this program, such as "aquarama
// console". Otherwise the program keeps its own name.
void takeTypedName(CLI::App& app, const std::string& typed) {
    if (typed == "aquarama" || typed.starts_with("aquarama ")) app.name(typed);
}

// Adds --version to the program and its commands, except those that another program runs.
void addVersionFlag(CLI::App& app, const std::string& program) {
    if (app.get_prefix_command()) return;
    if (!app.get_name().empty())
        app.set_version_flag(
            "--version",
            [program] { return program + " " + versionText(); },
            "print version, commit, build and libraries, and end");
    for (CLI::App* command : app.get_subcommands({})) addVersionFlag(*command, program);
}

// Reports an error to the supervisor; false where there is none.
bool tellSupervisor(const std::string& line) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody changes it
    const char* pipe = std::getenv(kErrorPipeVariable);
    if (pipe == nullptr) return false;
    const std::string whole = line + '\n';
    return write(std::atoi(pipe), whole.data(), whole.size()) == static_cast<ssize_t>(whole.size());
}

// The exit status after flushing standard output. A closed output is intended.
int withOutput(int status) {
    errno = 0;
    if ((std::fflush(stdout) == 0 && std::ferror(stdout) == 0) || errno == EBADF) return status;
    throw Error("standard output: " + whyNotWritten(errno != 0 ? errno : EIO));
}

// An argument without its leading dashes, which may be long ones.
std::string_view withoutDashes(std::string_view argument) {
    while (!argument.empty()) {
        const CodePoint first = codePointAt(argument, 0);
        if (first.code != '-' && asciiFor(first.code) != "-") break;
        argument.remove_prefix(first.bytes);
    }
    return argument;
}

// What to type instead of an argument with a long dash, as office programs and web pages make it;
// empty where it has none. Numbers are checked by their option.
std::string longDashOf(std::string_view argument) {
    if (argument.empty() || argument[0] == '-') return "";
    const std::string_view name = withoutDashes(argument);
    const bool hasDashes = name.size() < argument.size() && !name.empty();
    if (!hasDashes || !plainNumber(argument).empty()) return "";
    return "\"" + std::string(argument) + "\" begins with " + nameOf(codePointAt(argument, 0)) +
           ": type " + (name.size() == 1 ? "-" : "--") + std::string(name);
}

// The advice for the first such argument; empty where there is none.
std::string longDashIn(std::span<char* const> arguments) {
    for (const char* argument : arguments)
        if (std::string wrong = longDashOf(argument); !wrong.empty()) return wrong;
    return "";
}

// The message about a wrong command line, with a remark on its first character that is not ASCII.
int sayUsage(const CLI::App& app, const std::string& what, std::span<char* const> arguments) {
    std::string why = what;
    for (const std::string_view argument : arguments) {
        const std::string_view value = argument.substr(argument.find('=') + 1);  // or all of it
        const std::string foreign = foreignCharacterIn(value);
        if (foreign.empty() || what.find(value) == std::string::npos) continue;
        if (what.find(": type ") == std::string::npos) why += ": " + foreign;
        break;
    }
    const std::string command = commandOf(app);
    sayError(command, why + "; see " + command + " --help");
    return kUsage;
}

template <typename Number>
std::optional<Number> parsed(const std::string& text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

template <typename Number>
CLI::Validator between(Number least, Number most, const std::string& kind) {
    std::ostringstream text;
    text << least << " to " << most;
    const std::string range = text.str();
    return {[=](std::string& given) -> std::string {
                const auto isIn = [=](const std::string& said) {
                    const auto value = parsed<Number>(said);
                    return value && *value >= least && *value <= most;
                };
                if (isIn(given)) return {};
                const bool isMeant = isIn(plainNumber(given));
                return "\"" + given + "\" is not " + kind + " from " + range +
                       (isMeant ? ": type " + plainNumber(given) : "");
            },
            range};
}

constexpr std::array kWatched{SIGINT, SIGTERM, SIGHUP};

sigset_t watchedSignals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : kWatched) sigaddset(&signals, signal);
    return signals;
}

// Set where a thread that does not block the signals received one: libraries start some before
// main().
std::atomic<bool> strayed = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// Installs handlers, since such a thread would otherwise end the program. Ignored signals stay
// ignored (nohup).
void catchStray(int signal) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_DFL) return;
    struct sigaction stray {};
    stray.sa_handler = [](int) { strayed = true; };
    stray.sa_flags = SA_RESTART;
    sigaction(signal, &stray, nullptr);
}

}  // namespace

int runProgram(CLI::App& app, int count, char** arguments, const Job& job) {
    assert(!app.get_name().empty());
    if (count > 0) takeTypedName(app, arguments[0]);
    addVersionFlag(app, app.get_name());
    const std::span<char* const> given(arguments, static_cast<std::size_t>(std::max(0, count)));
    const std::string longDash = longDashIn(given);
    try {
        app.parse(count, arguments);
        if (!longDash.empty()) return sayUsage(app, longDash, {});
        std::signal(SIGXFSZ, SIG_IGN);  // a file beyond its size limit is an error of its writer
        removeLeftFolders();
        return withOutput(job());
    } catch (const CLI::ParseError& wrong) {
        if (wrong.get_exit_code() == 0) return app.exit(wrong);  // --help or --version
        return longDash.empty() ? sayUsage(app, wrong.what(), given) : sayUsage(app, longDash, {});
    } catch (const std::exception& error) {
        sayError(commandOf(app), error.what());
        return kFailed;
    }
}

std::string buildText() {
    std::istringstream lines(versionText());
    std::string version, commit;
    std::getline(lines, version);
    lines >> commit;  // the word "commit"
    std::getline(lines >> std::ws, commit);
    return version + " " + commit;
}

void sayError(const std::string& program, const std::string& what) {
    std::string line = program + ": " + what;
    std::ranges::replace(line, '\n', ' ');
    line = legible(line);
    if (!tellSupervisor(line)) std::cerr << line << '\n';
}

CLI::Validator wholeNumber(std::uint64_t least, std::uint64_t most) {
    assert(least <= most);
    return between(least, most, "a whole number");
}

CLI::Validator number(double least, double most) {
    assert(least <= most);
    return between(least, most, "a number");
}

CLI::Validator plainWord() {
    return {[](std::string& given) -> std::string {
                for (std::size_t at = 0; at < given.size(); at += codePointAt(given, at).bytes) {
                    const CodePoint point = codePointAt(given, at);
                    const bool isSeen =
                        point.code >= ' ' && !isControl(point.code) && !isInvisible(point.code);
                    if (!point.isUtf8 || !isSeen)
                        return "\"" + given + "\" has " + nameOf(point) + ": type it without";
                }
                return {};
            },
            ""};
}

void holdSignals() {
    const sigset_t signals = watchedSignals();
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    for (const int signal : kWatched) catchStray(signal);
}

SignalWatch::SignalWatch(std::function<void()> onSignal) {
    const sigset_t signals = watchedSignals();
    thread_ = std::jthread([signals, call = std::move(onSignal)](const std::stop_token& ended) {
        constexpr timespec kPollInterval{.tv_sec = 0, .tv_nsec = 50'000'000};
        while (!ended.stop_requested())
            if (sigtimedwait(&signals, nullptr, &kPollInterval) > 0 || strayed.exchange(false))
                call();
    });
}

}  // namespace aquarama::cli
