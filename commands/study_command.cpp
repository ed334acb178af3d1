// SPDX-License-Identifier: Apache-2.0
// `aquarama study`: runs worlds with and without each adaptation of the mind to its motor; or a
// chronicle of one scene.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>

#include "capture/capture_repertoire.h"
#include "commands/commands.h"
#include "commands/study_data.h"
#include "common/base/log.h"
#include "common/cli/progress.h"
#include "master/study/chronicle.h"
#include "master/study/study.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// Options of the study. Without a folder the data goes to a temporary one. `minutes` is world time.
struct StudyOptions {
    std::string out;
    std::string config;
    double minutes = 10;
    std::uint32_t seeds = 5;
};

StudyScript studyScript() {
    return {"master/study/draw_study.py", {"matplotlib", "scipy"}};
}

// Runs the study with a progress bar.
std::vector<study::Sample> watched(const study::StudyPlan& plan) {
    cli::Progress bar("studying");
    std::mutex mutex;
    return study::runStudy(plan, [&](double share) {
        const std::scoped_lock lock(mutex);
        bar.show(share);
    });
}

void runStudy(const StudyOptions& options) {
    StudyData::require(studyScript(), options.out);
    const fs::path config = configFolder(options.config);
    const study::StudyPlan plan{.scenarios = study::scenariosOf(config),
                                .minutes = options.minutes,
                                .seeds = options.seeds,
                                .threads = std::max(std::thread::hardware_concurrency(), 1U)};
    const std::string runs = study::runsCsv(plan, watched(plan));
    const StudyData folder(studyScript(), options.out);
    folder.write("adaptation.csv", runs);
    folder.show("adaptation", folder.isKept() ? "figure" : "");
    std::cout << '\n' << versionsLine();
}

struct ChronicleOptions {
    std::string scene;
    std::string out;
    double hours = 1;  // of the scene's time
    std::uint32_t seed = 1;
};

void chronicle(const ChronicleOptions& options) {
    StudyData::require(studyScript(), options.out);
    study::Scenario scenario = study::readScenario(options.scene);
    scenario.world.seed = options.seed;
    world::World world(scenario.world);
    if (world.traits().empty())
        throw Error(options.scene + ": has no fish to tell of; choose a scene with fish");
    constexpr std::uint64_t kTicksOfMinute = 3600;
    constexpr std::uint64_t kTicksOfHour = 60 * kTicksOfMinute;
    study::Chronicle chronicle(world, scenario.halfWidths, scenario.world.cast, kTicksOfHour);
    cli::Progress bar("living");
    const auto ticks = static_cast<std::uint64_t>(options.hours * kTicksOfHour);
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
        world.advance();
        chronicle.note(world);
        if (tick % kTicksOfMinute == 0)
            bar.show(static_cast<double>(tick) / static_cast<double>(ticks));
    }
    const StudyData folder(studyScript(), options.out);
    folder.write("hours.csv", study::hoursCsv(chronicle.hours()));
    folder.write("overlaps.csv",
                 study::overlapsCsv(chronicle.overlaps(), world, scenario.world.cast));
    folder.show("chronicle", std::to_string(options.hours));
    std::cout << "\nhash of the world: " << std::hex << world.hash() << std::dec << '\n'
              << versionsLine() << '\n'
              << study::speciesText(chronicle.species(), scenario.world.cast);
}

}  // namespace

void addStudy(CommandLine& line) {
    const auto [command, options] =
        line.add<StudyOptions>("study",
                               "compare minds with and without each adaptation to their motor; "
                               "study chronicle SCENE: an hour "
                               "of a scene in figures; "
                               "study wall RIG: what a visitor sees",
                               runStudy);
    command.require_subcommand(0, 1);
    command.footer("Prints its tables in Markdown.");
    command.add_option("--out", options.out, "folder for a table of all runs and a figure");
    command.add_option("--minutes", options.minutes, "of each run")
        ->check(cli::number(0.1, 1440))
        ->capture_default_str();
    command.add_option("--seeds", options.seeds, "runs of each kind")
        ->check(cli::wholeNumber(1, 100))
        ->capture_default_str();
    describeConfig(command, options.config);
    const auto [life, chronicled] = line.addTo<ChronicleOptions>(
        command, "chronicle", "what happens in a scene, hour by hour", chronicle);
    life.group("Commands");
    life.add_option("SCENE", chronicled.scene, "the scene's file")->required();
    life.add_option("--out", chronicled.out, "folder for the hours and overlaps as tables");
    life.add_option("--hours", chronicled.hours, "of the scene")
        ->check(cli::number(0.01, 1000))
        ->capture_default_str();
    life.add_option("--seed", chronicled.seed, "of the world")
        ->check(cli::wholeNumber(0, cli::kMostSeed))
        ->capture_default_str();
    addStudyWall(line, command);
}

}  // namespace aquarama
