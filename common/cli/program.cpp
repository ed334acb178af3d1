// SPDX-License-Identifier: Apache-2.0
#include "common/cli/program.h"

#include <algorithm>
#include <charconv>
#include <exception>
#include <iostream>
#include <optional>
#include <sstream>

#include "common/cli/causes.h"
#include "common/cli/version.h"

namespace aquarama::cli {

namespace {

constexpr int kFailed = 1;
constexpr int kUsage = 2;

// With the subcommand that was asked for: "aquarama run".
std::string commandOf(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? app.get_name() : app.get_name() + " " + chosen.front()->get_name();
}

int sayUsage(const CLI::App& app, const CLI::ParseError& wrong) {
    if (wrong.get_exit_code() == 0) return app.exit(wrong);  // --help or --version
    const std::string command = commandOf(app);
    sayError(command, wrong.what() + ("; see " + command + " --help"));
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
                const auto value = parsed<Number>(given);
                if (value && *value >= least && *value <= most) return {};
                return "\"" + given + "\" is not " + kind + " from " + range;
            },
            range};
}

}  // namespace

int runProgram(CLI::App& app, int count, char** arguments, const Job& job) {
    app.set_version_flag(
        "--version",
        [&app] { return app.get_name() + " " + versionText(); },
        "print version, commit, build and libraries, and end");
    try {
        app.parse(count, arguments);
        return job();
    } catch (const CLI::ParseError& wrong) {
        return sayUsage(app, wrong);
    } catch (const std::exception& error) {
        sayError(app.get_name(), error.what());
        return kFailed;
    }
}

void sayError(const std::string& program, const std::string& what) {
    std::string line = program + ": " + what;
    std::ranges::replace(line, '\n', ' ');
    if (!tellSupervisor(line)) std::cerr << line << '\n';
}

CLI::Validator wholeNumber(std::uint64_t least, std::uint64_t most) {
    return between(least, most, "a whole number");
}

CLI::Validator number(double least, double most) {
    return between(least, most, "a number");
}

}  // namespace aquarama::cli
