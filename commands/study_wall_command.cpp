// SPDX-License-Identifier: Apache-2.0
// `aquarama study wall`: what a visitor sees of a scene on a wall, over hours.
#include <cstdint>
#include <iostream>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/commands.h"
#include "commands/study_data.h"
#include "common/base/log.h"
#include "common/cli/outputs.h"
#include "common/cli/progress.h"
#include "common/config/rig.h"
#include "common/config/scene.h"
#include "master/study/study.h"
#include "master/study/wall_study.h"

namespace aquarama {

namespace {

// `hours` are of the scene's time.
struct WallStudyOptions {
    std::string rig, scene, out;
    double hours = 1;
    std::uint32_t seed = 1;
    bool tours = false;
};

StudyScript wallScript() {
    return {"master/study/draw_wall.py", {"matplotlib"}};
}

// The scenario of a scene; with its tour where that is asked for.
study::Scenario wallScenario(const std::string& scene, const WallStudyOptions& options) {
    study::Scenario scenario = study::readScenario(scene);
    scenario.world.seed = options.seed;
    if (options.tours) scenario.world.scene.tour = config::readScene(scene).tour;
    return scenario;
}

// Runs the world with a bar of progress.
void watchWall(world::World& world, study::WallStudy& study, double hours) {
    constexpr std::uint64_t kTicksOfMinute = 3600;
    cli::Progress bar("watching");
    const auto ticks = static_cast<std::uint64_t>(hours * 60 * kTicksOfMinute);
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
        world.advance();
        study.note(world);
        if (tick % kTicksOfMinute == 0)
            bar.show(static_cast<double>(tick) / static_cast<double>(ticks));
    }
}

// By day, or by night where the scene has no day.
study::WallFigures mainFigures(const study::WallStudy& study) {
    const study::WallFigures day = study.figures(study::DayPart::Day);
    return day.seconds > 0 ? day : study.figures(study::DayPart::Night);
}

std::string pathLine(const study::WallStudy& study) {
    const study::PathPeak peak = study.pathPeak();
    return fmt::format(
        "path of the school: highest peak {:.2f} after {} s, the first nearly as high after {} s",
        peak.height,
        peak.lag,
        peak.firstLag);
}

// Where the visitor is.
std::string placeLine(const WallStudyOptions& options) {
    return options.tours ? "seen from the submarine on its tour" : "seen from the eye at rest";
}

void studyWall(const WallStudyOptions& options) {
    StudyData::require(wallScript(), options.out);
    const config::Rig rig = config::readRig(options.rig);
    const std::string scene =
        options.scene.empty() ? config::scenePathOf(rig, options.rig) : options.scene;
    const study::Scenario scenario = wallScenario(scene, options);
    world::World world(scenario.world);
    if (world.traits().empty())
        throw Error(scene + ": has no fish to see; choose a scene with fish");
    study::WallStudy study(rig, world);
    watchWall(world, study, options.hours);
    const StudyData data(wallScript(), options.out);
    data.write("seconds.csv", study::secondsCsv(study));
    data.write("measures.csv", study::measuresCsv(study));
    data.write("events.csv", study::eventsCsv(study));
    data.write("species.csv", study::wallSpeciesCsv(study, world, scenario.world.cast));
    cli::say(study::wallLine(mainFigures(study)));
    cli::say(placeLine(options));
    cli::say(pathLine(study));
    data.show("wall", data.isKept() ? "figure" : "");
    std::cout << versionsLine();
}

}  // namespace

void addStudyWall(CommandLine& line, CLI::App& studies) {
    const auto [command, options] = line.addTo<WallStudyOptions>(
        studies, "wall", "what a visitor sees of a scene on a wall", studyWall);
    command.group("Commands");
    command.footer(
        "Prints a line that sums up the day, and its tables in Markdown. The bounds that the "
        "default "
        "scene is held to (docs/scenes.md) are of the eye at rest; --tour is held to none.");
    command.add_option("RIG", options.rig, "the wall's file")->required();
    command.add_option("--scene", options.scene, "another scene than the rig's");
    command.add_flag(
        "--tour", options.tours, "the submarine tours; without, it rests at the scene's eye");
    command.add_option("--out", options.out, "folder for the tables as CSV and a figure");
    command.add_option("--hours", options.hours, "of the scene")
        ->check(cli::number(0.01, 1000))
        ->capture_default_str();
    command.add_option("--seed", options.seed, "of the world")
        ->check(cli::wholeNumber(0, cli::kMostSeed))
        ->capture_default_str();
}

}  // namespace aquarama
