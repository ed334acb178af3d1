// SPDX-License-Identifier: Apache-2.0
// `aquarama schedule`: what the hours of a rig say, without a browser.
#include <filesystem>
#include <optional>
#include <regex>
#include <string>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>

#include "commands/commands.h"
#include "common/base/counted.h"
#include "common/base/dates.h"
#include "common/base/log.h"
#include "common/cli/outputs.h"
#include "common/config/calendar.h"
#include "common/config/hours.h"
#include "common/config/rig.h"

namespace aquarama {

namespace {

// A year has a day more now and then.
constexpr int kDaysAhead = 366;

// Options of all three, each of which uses some.
struct ScheduleOptions {
    std::string file;  // a rig or hours
    std::string at;    // as the clock of the hall shows it; empty: now
};

// Hours, and the file that they were read from.
struct ReadSchedule {
    std::string file;
    config::Hours hours;
};

// Hours have no channels, and every rig has.
bool hasChannels(const std::string& text) {
    static const std::regex channels(R"((^|\n)\s*channels\b)");
    return std::regex_search(text, channels);
}

ReadSchedule scheduleIn(const std::string& path, const std::string& text) {
    return {path, config::parseHours(text, path)};
}

// The hours that the console keeps of a rig. Throws Error where there are none.
ReadSchedule scheduleOf(const std::string& rigPath, const config::Rig& rig) {
    const std::string path = (config::consoleFolderOf(rigPath) / config::kHoursFile).string();
    if (!std::filesystem::exists(path))
        throw Error(path + ": is not there, so " + rigPath +
                    " has no hours; enter them in the console (Schedule)");
    ReadSchedule schedule = scheduleIn(path, config::readTextFile(path));
    for (const std::string& scene : config::scenesOf(schedule.hours))
        static_cast<void>(config::scenePathOf(scene, rigPath, rig.scene));
    return schedule;
}

ReadSchedule scheduleFor(const ScheduleOptions& options) {
    const std::string text = config::readTextFile(options.file);
    if (!hasChannels(text)) return scheduleIn(options.file, text);
    return scheduleOf(options.file, config::parseRig(text, options.file));
}

// The moment that is asked for. Throws Error where the clock is wrong.
long long momentIn(const ScheduleOptions& options, const config::Hours& hours) {
    if (!options.at.empty()) return config::momentOf(hours.zone, options.at);
    if (const std::string doubt = clockDoubt(systemSeconds(), static_cast<double>(builtAt()));
        !doubt.empty())
        throw Error(doubt + ": nothing is opened or closed; " + kSetTheClock);
    return static_cast<long long>(systemSeconds());
}

void checkSchedule(const ScheduleOptions& options) {
    const auto [file, hours] = scheduleFor(options);
    cli::say(fmt::format("{}: good; {} a week, {}, {}, by the clock of {}",
                         file,
                         counted(hours.open.size(), "span"),
                         counted(hours.exceptions.size(), "day") + " of its own",
                         counted(hours.projectors.size(), "projector"),
                         hours.zone));
}

// What is wanted from a moment on, and when that is.
void sayLine(const config::Hours& hours, const config::HoursChange& change) {
    cli::say(fmt::format(
        "{:<34} {}", config::clockText(hours.zone, change.at), config::textOf(change.wanted)));
}

void sayNow(const ScheduleOptions& options) {
    const config::Hours hours = scheduleFor(options).hours;
    const long long now = momentIn(options, hours);
    sayLine(hours, {now, config::wantedAt(hours, now)});
}

void sayNext(const ScheduleOptions& options) {
    constexpr int kMostLines = 10;
    const config::Hours hours = scheduleFor(options).hours;
    long long after = momentIn(options, hours);
    for (int line = 0; line < kMostLines; ++line) {
        const auto change = config::changeAfter(hours, after, kDaysAhead);
        if (!change) return cli::say("no change within a year from then on");
        sayLine(hours, *change);
        after = change->at;
    }
}

template <class Run>
AddedCommand<ScheduleOptions> addQuestion(CommandLine& line,
                                          CLI::App& parent,
                                          const std::string& name,
                                          const std::string& what,
                                          Run run) {
    const auto added = line.addTo<ScheduleOptions>(parent, name, what, run);
    added.app
        .add_option("FILE", added.options.file, "a rig, whose hours the console keeps, or hours")
        ->required();
    return added;
}

void describeMoment(const AddedCommand<ScheduleOptions>& command) {
    command.app.add_option("--at",
                           command.options.at,
                           "instead of now, by the clock of the hall: \"2026-12-24 18:00\"");
}

}  // namespace

void addSchedule(CommandLine& line) {
    struct Nothing {};
    const auto schedule =
        line.add<Nothing>("schedule", "what the hours of a rig say", [](const Nothing&) {
            throw CLI::RequiredError("schedule: check, now or next");
        });
    addQuestion(line, schedule.app, "check", "whether the hours can be read", checkSchedule);
    describeMoment(addQuestion(line, schedule.app, "now", "what is wanted of the wall", sayNow));
    describeMoment(
        addQuestion(line, schedule.app, "next", "the ten changes that come next", sayNext));
}

}  // namespace aquarama
