// SPDX-License-Identifier: Apache-2.0
#include "commands/tour_findings.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <numbers>
#include <string_view>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "common/base/amounts.h"
#include "common/base/counted.h"
#include "common/base/dates.h"
#include "common/base/units.h"
#include "common/config/calendar.h"

namespace aquarama {

namespace {

StepFinding done(std::string what) {
    return {StepState::Done, std::move(what), {}};
}
StepFinding toConfirm(std::string what, std::string todo) {
    return {StepState::ToConfirm, std::move(what), std::move(todo)};
}
StepFinding toDo(std::string what, std::string todo) {
    return {StepState::ToDo, std::move(what), std::move(todo)};
}

std::string joined(const std::vector<std::string>& parts) {
    return fmt::format("{}", fmt::join(parts, "; "));
}

// The panels of a rig by their size.
std::string panelsOf(const config::Rig& rig) {
    std::vector<std::string> sizes;
    for (const config::Channel& channel : rig.channels)
        if (channel.panel)
            sizes.push_back(fmt::format(
                "{:.3f} x {:.3f} m", channel.panel->sizeMetres.x, channel.panel->sizeMetres.y));
    return "panels, " + joined(sizes);
}

// What a step says that needs a running show and has none.
StepFinding withoutShow(const std::string& rigPath, const MasterAnswer& master) {
    if (!master.preparing.empty()) return toDo(master.preparing, "wait until it is ready");
    if (!master.problem.empty())
        return toDo(master.problem, "mend that: without it nobody can ask the show");
    return toDo("no show runs",
                "start it: aquarama run " + rigPath +
                    ", or systemctl start aquarama.target on the master's machine");
}

// The name that a machine has on its network: "left-pc" of "Left-PC.hall.example".
std::string shortName(std::string_view host) {
    std::string name(host.substr(0, host.find('.')));
    std::ranges::transform(name, name.begin(), [](unsigned char letter) {
        return static_cast<char>(std::tolower(letter));
    });
    return name;
}

// "left on left-pc"
std::string seatOf(const v1::NodeStatus& node) {
    return node.name() + " on " + node.report().host();
}

// The verdict in the figures of a calibration; empty where it has none.
std::string verdictIn(const FileVersion& version) {
    const auto figures = nlohmann::json::parse(version.note, nullptr, false);
    const auto verdict = figures.find("verdict");  // of what is no object: nothing
    return verdict != figures.end() && verdict->is_string() ? verdict->get<std::string>() : "";
}

StepFinding judgeCalibration(const std::string& rigPath, const FileVersion& used) {
    const std::string verdict = verdictIn(used);
    if (verdict == "pass") return done("calibrated at " + used.name + " UTC: pass");
    if (verdict.empty())
        return toConfirm("calibrated by another program, at " + used.name + " UTC",
                         "look at the grid on the wall: aquarama set " + rigPath + " pattern grid");
    return toConfirm("calibrated at " + used.name + " UTC: " + verdict,
                     "read its report, do what it says and scan again, or keep it as it is");
}

std::string calibrateCommand(const std::string& rigPath) {
    const std::string hall = std::filesystem::path(rigPath).stem().string();
    return "aquarama calibrate --rig " + rigPath + " --camera /dev/video0 --out " + hall +
           ".mpcdi --report report";
}

}  // namespace

std::string_view nameOf(StepState state) {
    constexpr std::array<std::string_view, 3> kNames{"done", "confirm", "todo"};
    return kNames.at(static_cast<std::size_t>(state));
}

std::string textOf(const config::Rig& rig) {
    const config::Screen& screen = rig.screen;
    switch (screen.shape) {
        case config::ScreenShape::Cylinder:
            return fmt::format("cylinder, radius {:.3f} m, arc {:.1f} degrees, {:.3f} m high",
                               screen.radiusMetres,
                               degreesOf(screen.arcRadians),
                               screen.heightMetres);
        case config::ScreenShape::Flat:
            return fmt::format(
                "flat, {:.3f} m wide, {:.3f} m high", screen.widthMetres, screen.heightMetres);
        case config::ScreenShape::Dome:
            return fmt::format("dome, radius {:.3f} m, opening {:.1f} degrees",
                               screen.radiusMetres,
                               degreesOf(screen.arcRadians));
        case config::ScreenShape::Measured:
            return "measured, " + screen.meshFile;
        case config::ScreenShape::Panels:
            break;
    }
    return panelsOf(rig);
}

StepFinding lookAtScreen(const config::Rig& rig,
                         std::span<const std::pair<std::string, std::string>> shipped) {
    const std::string screen = textOf(rig);
    const auto same =
        std::ranges::find(shipped, screen, &std::pair<std::string, std::string>::second);
    if (same == shipped.end()) return done(screen);
    return toConfirm(screen + ", as in " + same->first + " of the programs",
                     "measure the screen with a tape, and correct it in the rig if it differs");
}

StepFinding lookAtMachines(const std::string& rigPath, const MasterAnswer& master) {
    if (!master.status) return withoutShow(rigPath, master);
    std::vector<std::string> absent;
    for (const v1::NodeStatus& node : master.status->nodes())
        if (node.condition() == v1::NODE_ABSENT)
            absent.push_back(node.name() + (node.machine().empty() ? "" : " of " + node.machine()));
    const auto all = static_cast<std::size_t>(master.status->nodes_size());
    if (absent.empty()) return done("all of " + counted(all, "node"));
    return toDo(
        fmt::format(
            "{} of {}; absent: {}", all - absent.size(), counted(all, "node"), joined(absent)),
        "start each on its machine: aquarama-node --key NAME.key, or systemctl enable --now "
        "aquarama-node@NAME; see cables and its log. A machine that shows a letter gets its "
        "channel in the console (Nodes), or by aquarama nodes assign");
}

StepFinding lookAtChannels(const std::string& rigPath,
                           const MasterAnswer& master,
                           std::span<const std::string> keyProblems,
                           const std::string& ownHost) {
    if (!keyProblems.empty())
        return toDo(joined({keyProblems.begin(), keyProblems.end()}),
                    "aquarama keys new " + rigPath + ", then aquarama keys bundle " + rigPath +
                        " NAME for each machine");
    if (!master.status) return withoutShow(rigPath, master);
    std::vector<std::string> seats, elsewhere;
    for (const v1::NodeStatus& node : master.status->nodes()) {
        if (!node.has_report())
            return toDo("nothing is known of the machine of " + node.name(),
                        "wait some seconds; where its node is absent, start it");
        const std::string& expected = node.machine().empty() ? ownHost : node.machine();
        seats.push_back(seatOf(node));
        if (shortName(node.report().host()) != shortName(expected))
            elsewhere.push_back(seatOf(node) + ", not on " + expected);
    }
    if (elsewhere.empty()) return done(joined(seats));
    return toConfirm(
        joined(elsewhere),
        "if it should be there, give that machine the key of that channel, or name the "
        "machine in the rig; if it is the same machine by another name, it is right");
}

StepFinding lookAtHealth(const std::string& rigPath, const Findings& findings) {
    std::vector<std::string> faults;
    std::size_t warnings = 0;
    bool runs = false;
    for (const Finding& finding : findings.all()) {
        if (finding.verdict == Verdict::Fail)
            faults.push_back(finding.subject + ": " + finding.what);
        warnings += finding.verdict == Verdict::Warn ? 1 : 0;
        runs = runs || (finding.subject == "show" && finding.verdict == Verdict::Pass);
    }
    if (!faults.empty())
        return toDo(joined(faults), "aquarama doctor " + rigPath + " says what to do about each");
    if (!runs) return withoutShow(rigPath, {});
    return done("no fault, " + counted(warnings, "warning") +
                (warnings > 0 ? ": aquarama doctor " + rigPath : ""));
}

StepFinding lookAtFocus(const std::string& rigPath,
                        const config::Rig& rig,
                        const MasterAnswer& master,
                        const std::string& confirmed) {
    std::vector<std::string> names;
    for (const config::Channel& channel : rig.channels) names.push_back(channel.name);
    const std::string grid = "grid on " + joined(names);
    if (confirmed == grid) return done(grid);
    if (!master.status) return withoutShow(rigPath, master);
    if (master.status->show().black())
        return toDo("the wall is black", "aquarama set " + rigPath + " black off");
    return toConfirm(grid,
                     "focus each projector until the lines of the grid are sharp in its corners; "
                     "switch keystone correction and scaling off");
}

StepFinding lookAtCalibration(const std::string& rigPath,
                              const config::Rig& rig,
                              std::span<const FileVersion> kept) {
    if (rig.screen.shape == config::ScreenShape::Panels) return done("panels need none");
    const bool isOfWallFiles =
        std::ranges::all_of(rig.channels, [](const auto& one) { return one.wallFile.has_value(); });
    if (isOfWallFiles) return done("each channel has its wall file");
    if (rig.calibration.empty())
        return toDo("the rig names no calibration",
                    calibrateCommand(rigPath) + "; then name it in the rig: calibration: \"...\"");
    const auto used = std::ranges::find_if(kept, &FileVersion::isInUse);
    if (used == kept.end())
        return toConfirm(rig.calibration + " is of another program",
                         "look at the grid on the wall: aquarama set " + rigPath + " pattern grid");
    return judgeCalibration(rigPath, *used);
}

StepFinding lookAtHours(const std::string& rigPath,
                        const std::optional<config::Hours>& hours,
                        long long now) {
    constexpr int kDaysAhead = 366;
    if (!hours)
        return toConfirm("no hours: the wall shows the world whenever it has power",
                         "enter them in the console (aquarama console " + rigPath +
                             "; Schedule), if it should open and close by itself");
    const auto change = config::changeAfter(*hours, now, kDaysAhead);
    if (!change)
        return toConfirm(
            "the hours say " + config::textOf(config::wantedAt(*hours, now)) + " for a year",
            "correct them in the console (Schedule), if it should open and close");
    return done(fmt::format("now {}; {}: {}",
                            config::textOf(config::wantedAt(*hours, now)),
                            config::clockText(hours->zone, change->at),
                            config::textOf(change->wanted)));
}

StepFinding lookAtBackup(const std::string& rigPath, const BackupFacts& facts, double seenAt) {
    constexpr double kClockOfStick = 2;  // FAT keeps times to two seconds
    if (facts.file.empty())
        return toDo(
            "no folder is named",
            "put a stick in, and name it: aquarama tour " + rigPath + " --backup /media/stick");
    const std::string command = "aquarama hall export " + rigPath + " " + facts.file;
    const double written = facts.writtenAt > 0 ? facts.writtenAt : seenAt;
    if (written == 0) return toDo(facts.file + " is not there", command);
    const std::string copy = facts.file + " of " + dayOf(written);
    if (written + kClockOfStick < facts.hallChangedAt)
        return toDo(copy + ", and the hall has changed since", command);
    if (facts.isOnDiskOfRig)
        return toConfirm(copy + ", on the disk of the hall itself",
                         "copy it to a stick, and keep the stick elsewhere");
    return done(copy + (facts.writtenAt > 0 ? "" : ", not in this machine now"));
}

}  // namespace aquarama
