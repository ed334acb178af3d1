// SPDX-License-Identifier: Apache-2.0
// `aquarama study`: runs worlds with and without each adaptation of the mind to its motor; or a
// chronicle of one scene.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "capture/capture_repertoire.h"
#include "commands/commands.h"
#include "commands/study_data.h"
#include "commands/work_parts.h"
#include "common/base/byte_stream.h"
#include "common/base/digest.h"
#include "common/base/log.h"
#include "common/cli/outputs.h"
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
    std::optional<parts::Part> part;
};

StudyScript studyScript() {
    return {"master/study/draw_study.py", {"matplotlib", "scipy"}};
}

// Makes some runs of the study, with a progress bar.
std::vector<study::Figures> watched(const study::StudyPlan& plan, parts::UnitRange runs) {
    cli::Progress bar("studying");
    std::mutex mutex;
    return study::runSome(plan, runs.first, runs.last, [&](double share) {
        const std::scoped_lock lock(mutex);
        bar.show(share);
    });
}

// Writes the table of all runs; Python prints the tables and draws the figure.
void showStudy(const study::StudyPlan& plan,
               std::span<const study::Figures> runs,
               const std::string& out) {
    const StudyData folder(studyScript(), out);
    folder.write("adaptation.csv", study::runsCsv(plan, study::samplesOf(plan, runs)));
    folder.show("adaptation", folder.isKept() ? "figure" : "");
    std::cout << '\n' << versionsLine();
}

// Files and options from which the figures follow.
Digest inputsOf(const study::StudyPlan& plan) {
    ByteWriter content;
    for (const study::Scenario& scenario : plan.scenarios)
        content.characters(scenario.inputs.bytes);
    content.unsignedNumber(bitsOf(plan.minutes));
    content.unsignedNumber(plan.seeds);
    return digestOf(content.written());
}

// A part holds the figures of its runs, behind the names of the scenarios and the number of seeds.
std::vector<std::byte> contentOf(const study::StudyPlan& plan,
                                 std::span<const study::Figures> runs) {
    ByteWriter writer;
    writer.unsignedNumber(plan.seeds);
    writer.unsignedNumber(static_cast<std::uint32_t>(plan.scenarios.size()));
    for (const study::Scenario& scenario : plan.scenarios) {
        writer.unsignedNumber(static_cast<std::uint32_t>(scenario.name.size()));
        writer.characters(scenario.name);
    }
    for (const study::Figures& run : runs) writer.numbers(std::span<const double>(run));
    return std::move(writer).take();
}

// What contentOf() wrote: the plan, as far as tables need it, and the part's figures behind `runs`.
study::StudyPlan readContent(const parts::FinishedPart& part, std::vector<study::Figures>& runs) {
    constexpr std::uint32_t kMostScenarios = 10000;
    ByteReader reader(part.content);
    study::StudyPlan plan{.scenarios = {}, .seeds = reader.unsignedNumber<std::uint32_t>()};
    const auto scenarios = reader.unsignedNumber<std::uint32_t>();
    requireWhole(reader.ok() && scenarios <= kMostScenarios, part);
    for (std::uint32_t i = 0; i < scenarios; ++i)
        plan.scenarios.emplace_back().name =
            reader.characters(reader.unsignedNumber<std::uint32_t>());
    requireWhole(reader.ok() && reader.remaining() % sizeof(study::Figures) == 0, part);
    while (reader.remaining() > 0) reader.numbers(std::span<double>(runs.emplace_back()));
    return plan;
}

void runStudy(const StudyOptions& options) {
    if (options.part)
        cli::requireFile("--out", parts::partPath(options.out, *options.part));
    else
        StudyData::require(studyScript(), options.out);
    const fs::path config = configFolder(options.config);
    const study::StudyPlan plan{.scenarios = study::scenariosOf(config),
                                .minutes = options.minutes,
                                .seeds = options.seeds,
                                .threads = std::max(std::thread::hardware_concurrency(), 1U)};
    const auto runs =
        watched(plan, parts::unitsOf(options.part.value_or(parts::Part{}), study::runsOf(plan)));
    if (options.part)
        writePart(options.out,
                  *options.part,
                  parts::WorkKind::Study,
                  inputsOf(plan),
                  contentOf(plan, runs));
    else
        showStudy(plan, runs, options.out);
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

void mergeStudy(const std::string& out, const WorkInParts& work) {
    StudyData::require(studyScript(), out);
    study::StudyPlan plan;
    std::vector<study::Figures> runs;
    for (const parts::FinishedPart& part : work) plan = readContent(part, runs);
    requireWhole(runs.size() == study::runsOf(plan), work.back());
    showStudy(plan, runs, out);
}

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
    CLI::Option* out =
        command.add_option("--out", options.out, "folder for a table of all runs and a figure");
    describePart(command, options.part);
    command.get_option("--part")->needs(out);
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
