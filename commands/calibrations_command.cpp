// SPDX-License-Identifier: Apache-2.0
// `aquarama calibrations`: lists the kept calibrations of a rig, and restores one.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "commands/commands.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/versions.h"
#include "common/config/rig.h"
#include "common/wall/wall.h"

namespace aquarama {

namespace {

struct CalibrationsOptions {
    std::string rig;
    std::string use;  // number or date; empty: list them
};

// A length in pixels as text; NaN on a wall without neighbours.
std::string neighboursIn(double apart, double most) {
    if (std::isnan(apart)) return "";
    return fmt::format("neighbours part by {:.2f} px, at most {:.2f}; ", apart, most);
}

// The contents of figures.json as a text.
std::string figuresIn(const std::string& note) {
    const auto figures = nlohmann::json::parse(note, nullptr, false);
    if (!figures.is_object()) return "no figures";
    const auto number = [&](const char* name) {
        const auto found = figures.find(name);
        return found != figures.end() && found->is_number() ? found->get<double>() : std::nan("");
    };
    const auto verdict = figures.find("verdict");
    const std::string neighbours = neighboursIn(number("overlap_rms_px"), number("overlap_max_px"));
    return fmt::format("{}, {}place {:.2f} px",
                       verdict != figures.end() && verdict->is_string()
                           ? verdict->get<std::string>()
                           : "no verdict",
                       neighbours,
                       number("absolute_rms_px"));
}

// The date "2026-11-24T210301" in a form that is easy to read.
std::string dateIn(const std::string& name) {
    constexpr std::size_t kLength = 17;
    if (name.size() < kLength) return name;
    return name.substr(0, 10) + " " + name.substr(11, 2) + ":" + name.substr(13, 2) + ":" +
           name.substr(15) + " UTC";
}

// Numbers begin at 1, as --use takes them.
void print(const std::vector<FileVersion>& versions, const std::string& file) {
    for (std::size_t i = 0; i < versions.size(); ++i)
        std::cout << fmt::format("{:3}  {}  {}{}\n",
                                 i + 1,
                                 dateIn(versions[i].name),
                                 figuresIn(versions[i].note),
                                 versions[i].isInUse ? "; in use" : "");
    std::cout << fmt::format("{}: {} kept\n", file, versions.size());
}

// Finds a calibration by its number or the beginning of its date.
const FileVersion& chosen(const std::vector<FileVersion>& versions, const std::string& use) {
    for (std::size_t i = 0; i < versions.size(); ++i)
        if (use == std::to_string(i + 1)) return versions[i];
    constexpr std::size_t kLeastDate = 10;
    const auto found = std::ranges::find_if(versions, [&](const FileVersion& version) {
        return use.size() >= kLeastDate && version.name.starts_with(use);
    });
    if (found != versions.end()) return *found;
    throw Error("no calibration \"" + use +
                "\" is kept; give a number of the list, or a date as in 2026-11-24T2103");
}

// Throws Error where the rig cannot be shown with it.
void check(config::Rig rig, const std::string& path, const FileVersion& version) {
    config::readRigFiles(rig, path);
    rig.files[rig.calibration] = std::make_shared<const std::vector<std::byte>>(
        readWhole(version.path, config::kMostWallFileBytes));
    wall::checkGeometry(rig, path);
}

// Checks a chosen version with the whole rig before it replaces the file. Prints the list in either
// case.
void listOrUse(const CalibrationsOptions& options) {
    const config::Rig rig = config::parseRig(config::readTextFile(options.rig), options.rig);
    if (rig.calibration.empty())
        throw Error(options.rig + ": names no calibration; see docs/calibration.md");
    const std::string file = config::besideFile(options.rig, rig.calibration);
    if (!options.use.empty()) {
        const auto versions = versionsOf(file);
        const FileVersion& version = chosen(versions, options.use);
        check(rig, options.rig, version);
        useVersion(file, version);
    }
    print(versionsOf(file), file);
}

}  // namespace

void addCalibrations(CommandLine& line) {
    const auto [command, options] = line.add<CalibrationsOptions>(
        "calibrations", "list the kept calibrations of a rig, and restore one", listOrUse);
    command.add_option("RIG", options.rig, "the rig, which names its calibration")->required();
    command.add_option("--use", options.use, "show this one again: number of the list, or date");
    command.footer("A running wall shows it within a second, between two frames.");
}

}  // namespace aquarama
