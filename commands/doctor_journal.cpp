// SPDX-License-Identifier: Apache-2.0
#include "commands/doctor_journal.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <string>
#include <system_error>

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include "common/base/amounts.h"
#include "common/base/counted.h"
#include "common/base/files.h"
#include "common/base/output_file.h"
#include "common/cli/command_line.h"
#include "common/wire/recording.h"
#include "master/journal/journal.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSubject = "journal";

// Why files cannot be made in a folder, or in the nearest that is there; 0: they can.
int whyNoFilesIn(fs::path folder) {
    std::error_code none;
    while (folder.has_relative_path() && !fs::exists(folder, none)) folder = folder.parent_path();
    if (!fs::is_directory(folder, none)) return ENOTDIR;
    return access(folder.c_str(), W_OK | X_OK) == 0 ? 0 : errno;
}

// False: no journal can be written there.
bool lookAtFolder(Findings& findings, const fs::path& folder) {
    std::error_code none;
    const int problem = whyNoFilesIn(folder);
    const bool isThere = fs::exists(folder, none);
    findings.judge(problem == 0,
                   Verdict::Fail,
                   kSubject,
                   folder.string() + (problem != 0 ? ": " + whyNotWritten(problem)
                                      : isThere    ? ", can be written"
                                                   : ", the first show makes it"),
                   "without it a master that dies begins a new world");
    return problem == 0;
}

// What the recordings of a journal grow by in a day, as the last of them has; that of the reef
// where it is too short to tell.
double bytesOfADay(const wire::Recording* recording) {
    constexpr double kOfTheReef = 150e6, kDay = 86400, kTelling = 600;
    if (recording == nullptr || recording->saves.empty()) return kOfTheReef;
    const auto ticks = recording->lastTick().value - recording->saves.front().tick.value;
    const double seconds = static_cast<double>(ticks) / kTicksPerSecond;
    if (seconds < kTelling) return kOfTheReef;
    return static_cast<double>(recording->wholeBytes) / seconds * kDay;
}

// Beyond what is written already.
void lookAtRoom(Findings& findings, const fs::path& folder, const wire::Recording* recording) {
    constexpr double kDays = 3;
    const auto wanted = static_cast<std::uint64_t>(kDays * bytesOfADay(recording));
    const std::uint64_t missing = wanted - std::min(wanted, journal::bytesIn(folder));
    const std::uint64_t free = freeBytesAt(folder);
    findings.judge(
        free > missing,
        Verdict::Warn,
        kSubject,
        fmt::format("{} free, three days of the show take {}", sizeOf(free), sizeOf(wanted)),
        "make room there: on a full disk the show goes on, its journal does not");
}

void lookAtRecording(Findings& findings, const wire::Recording& recording) {
    const std::string name = fs::path(recording.source).filename().string();
    findings.judge(recording.bytesLeftOver == 0,
                   Verdict::Warn,
                   kSubject,
                   recording.bytesLeftOver == 0
                       ? fmt::format("{} reads to its end, {}", name, timeOf(recording.lastTick()))
                       : fmt::format("{} reads to {}; {} behind that cannot be read",
                                     name,
                                     timeOf(recording.lastTick()),
                                     counted(recording.bytesLeftOver, "byte")),
                   "the world goes on from there; if no power cut explains it, check the disk");
    const bool isOfThisBuild =
        recording.protocol == wire::kProtocolMajor && cli::buildText().starts_with(recording.build);
    findings.judge(
        isOfThisBuild,
        Verdict::Warn,
        kSubject,
        fmt::format(
            "{} was written by build {}, protocol {}", name, recording.build, recording.protocol),
        fmt::format("this is {}, protocol {}: a new world begins if its fish decide or "
                    "move otherwise",
                    cli::buildText(),
                    wire::kProtocolMajor));
}

// What an operator does about a journal of this condition.
const char* adviceFor(v1::JournalStatus::Condition condition) {
    switch (condition) {
        case v1::JournalStatus::WAITING:
            return "look at the disk and its cable; dmesg says what the kernel knows";
        case v1::JournalStatus::PAUSED:
            return "make room on its disk, or mend it: it goes on within a minute";
        default:
            return "end the other show of this rig, or let this user write there; then start again";
    }
}

}  // namespace

void lookAtJournal(Findings& findings, const fs::path& folder) {
    if (!lookAtFolder(findings, folder)) return;
    const std::vector<fs::path> recordings = journal::recordingsIn(folder);
    if (recordings.empty()) return lookAtRoom(findings, folder, nullptr);
    try {
        const wire::Recording recording = wire::readRecording(recordings.back().string());
        lookAtRoom(findings, folder, &recording);
        lookAtRecording(findings, recording);
    } catch (const Error& problem) {
        lookAtRoom(findings, folder, nullptr);
        findings.judge(false,
                       Verdict::Warn,
                       kSubject,
                       problem.what(),
                       "the world goes on from the recording before it; check the disk");
    }
}

void lookAtJournal(Findings& findings, const v1::JournalStatus& journal) {
    findings.judge(wire::journalProblem(journal).empty(),
                   Verdict::Warn,
                   kSubject,
                   wire::journalText(journal),
                   adviceFor(journal.condition()));
}

}  // namespace aquarama
