// SPDX-License-Identifier: Apache-2.0
#include "commands/tour_steps.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

#include "common/base/dates.h"
#include "common/base/log.h"
#include "common/base/versions.h"
#include "common/cli/outputs.h"
#include "common/config/hours.h"
#include "common/config/keys.h"
#include "common/wall/wall.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// The screens of the rigs that come with the programs, by their files.
std::vector<std::pair<std::string, std::string>> shippedScreens() {
    std::vector<std::pair<std::string, std::string>> screens;
    const fs::path folder = fs::path(cli::findData("config/desk.txtpb")).parent_path();
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".txtpb") continue;
        const std::string path = entry.path().string();
        screens.emplace_back(entry.path().filename().string(),
                             textOf(config::parseRig(config::readTextFile(path), path)));
    }
    std::ranges::sort(screens);
    return screens;
}

// Why a key cannot be used; empty: it can.
std::string keyProblemOf(const fs::path& file) {
    try {
        const config::KeyFile key = config::readKeyFile(file);
        return key.revoked.empty() ? "" : "key " + key.name + " was revoked on " + key.revoked;
    } catch (const Error& problem) {
        return problem.what();
    }
}

// Of the keys that nodes need.
std::vector<std::string> keyProblemsOf(const TourView& view) {
    std::vector<std::string> problems;
    if (!config::needsKeys(view.rig)) return problems;
    const fs::path folder = config::keyFolderOf(view.rigPath);
    for (const config::Channel& channel : view.rig.channels)
        if (std::string problem = keyProblemOf(config::keyFileIn(folder, channel.name));
            !problem.empty())
            problems.push_back(std::move(problem));
    return problems;
}

std::string ownHost() {
    std::array<char, 256> name{};
    gethostname(name.data(), name.size() - 1);
    return name.data();
}

std::vector<FileVersion> calibrationsOf(const TourView& view) {
    if (view.rig.calibration.empty()) return {};
    return versionsOf(config::besideFile(view.rigPath, view.rig.calibration));
}

fs::path hoursOf(const std::string& rigPath) {
    return config::consoleFolderOf(rigPath) / config::kHoursFile;
}

std::optional<config::Hours> readHours(const TourView& view) {
    const std::string path = hoursOf(view.rigPath).string();
    if (!fs::exists(path)) return std::nullopt;
    return config::parseHours(config::readTextFile(path), path);
}

// Whose Unix time is that of its last change; 0 where there is no such file.
double changedAt(const fs::path& path) {
    struct stat facts {};
    return stat(path.c_str(), &facts) == 0 ? static_cast<double>(facts.st_mtime) : 0;
}

bool areOnOneDisk(const fs::path& one, const fs::path& other) {
    struct stat first {
    }, second{};
    return stat(one.c_str(), &first) == 0 && stat(other.c_str(), &second) == 0 &&
           first.st_dev == second.st_dev;
}

// When the newest of what leaves with the hall was changed.
double hallChangedAt(const std::string& rigPath, const config::Rig& rig) {
    double newest = std::max(changedAt(rigPath), changedAt(hoursOf(rigPath)));
    for (const auto& [name, content] : rig.files)
        newest = std::max(newest, changedAt(config::besideFile(rigPath, name)));
    const fs::path keys = config::keyFolderOf(rigPath);
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(keys, none))
        newest = std::max(newest, changedAt(entry.path()));
    return newest;
}

BackupFacts backupOf(const TourView& view) {
    BackupFacts facts;
    if (view.record.backupFolder.empty()) return facts;
    const fs::path folder = view.record.backupFolder;
    const fs::path file = folder / (fs::path(view.rigPath).stem().string() + ".aqhall");
    facts.file = file.string();
    facts.writtenAt = changedAt(file);
    facts.isOnDiskOfRig =
        facts.writtenAt > 0 && areOnOneDisk(folder, fs::absolute(view.rigPath).parent_path());
    facts.hallChangedAt = hallChangedAt(view.rigPath, view.rig);
    return facts;
}

StepFinding lookAtHoursOf(const TourView& view) {
    if (const std::string doubt = clockDoubt(systemSeconds(), static_cast<double>(builtAt()));
        !doubt.empty())
        return {StepState::ToDo, doubt, kSetTheClock};
    return lookAtHours(view.rigPath, readHours(view), static_cast<long long>(systemSeconds()));
}

std::string confirmedOf(const TourView& view, const std::string& step) {
    const auto found = view.record.steps.find(step);
    return found == view.record.steps.end() ? "" : found->second.confirmed;
}

constexpr const char* kFocus = "focus";

const std::array kSteps{
    TourStep{"screen",
             "the screen is as the rig has it",
             [](const TourView& view) { return lookAtScreen(view.rig, shippedScreens()); }},
    TourStep{"machines",
             "the node of every channel is there",
             [](const TourView& view) { return lookAtMachines(view.rigPath, view.master); }},
    TourStep{"channels",
             "each channel has its key, and is shown by the machine that the rig names",
             [](const TourView& view) {
                 return lookAtChannels(view.rigPath, view.master, keyProblemsOf(view), ownHost());
             }},
    TourStep{"doctor",
             "the doctor finds no fault while the show runs",
             [](const TourView& view) {
                 return lookAtHealth(
                     view.rigPath,
                     view.master.status ? findingsOfDoctor(view.rigPath, "") : Findings{});
             }},
    TourStep{kFocus,
             "the projectors are focused",
             [](const TourView& view) {
                 return lookAtFocus(view.rigPath, view.rig, view.master, confirmedOf(view, kFocus));
             },
             true},
    TourStep{"calibration",
             "the wall is calibrated",
             [](const TourView& view) {
                 return lookAtCalibration(view.rigPath, view.rig, calibrationsOf(view));
             }},
    TourStep{"hours", "it opens and closes by itself", lookAtHoursOf},
    TourStep{"backup", "a copy of the hall lies elsewhere", [](const TourView& view) {
                 return lookAtBackup(view.rigPath, view.backup, view.record.backupWrittenAt);
             }}};

}  // namespace

TourView lookAround(const std::string& rigPath, const TourRecord& record) {
    TourView view{.rigPath = rigPath, .record = record};
    try {
        view.rig = config::readRig(rigPath);
        wall::checkGeometry(view.rig, rigPath);
    } catch (const Error& problem) {
        view.rigProblem = problem.what();
        return view;
    }
    view.master = answerOfMaster(rigPath, "");
    view.backup = backupOf(view);
    return view;
}

std::span<const TourStep> tourSteps() {
    return kSteps;
}

StepFinding findingOf(const TourStep& step, const TourView& view) {
    if (!view.rigProblem.empty()) return {StepState::ToDo, view.rigProblem, "correct the rig"};
    try {
        StepFinding finding = step.look(view);
        if (finding.state == StepState::ToConfirm && finding.what == confirmedOf(view, step.name))
            finding = {StepState::Done, finding.what, {}};
        return finding;
    } catch (const Error& problem) {
        return {StepState::ToDo, problem.what(), "correct that"};
    }
}

}  // namespace aquarama
