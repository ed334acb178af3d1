// SPDX-License-Identifier: Apache-2.0
// aquarama study: with and without each adaptation of the mind to its motor.
#include <filesystem>
#include <iostream>
#include <mutex>
#include <span>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>

#include "common/cli/outputs.h"
#include "common/cli/program.h"
#include "common/files/files.h"
#include "master/capture/compile/config_folder.h"
#include "master/capture/compile/progress_bar.h"
#include "master/capture/compile/repertoire_cache.h"
#include "master/study/chronicle.h"
#include "master/study/chronicle_report.h"
#include "master/study/scenarios.h"
#include "master/study/study_report.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

struct StudyOptions {
    std::string out;
    std::string config;
    double minutes = 10;
    std::uint32_t seeds = 5;
};

void writeText(const fs::path& path, const std::string& text) {
    files::writeWhole(path, std::as_bytes(std::span(text.data(), text.size())));
    std::cerr << path.string() << '\n';
}

std::vector<study::Sample> watched(const study::StudyPlan& plan) {
    capture::ProgressBar bar("studying");
    std::mutex mutex;
    return study::runStudy(plan, [&](double share) {
        const std::scoped_lock lock(mutex);
        bar.show(share);
    });
}

void runStudy(const StudyOptions& options) {
    cli::requireFolder("--out", options.out);
    const fs::path config =
        options.config.empty() ? capture::findConfigFolder() : fs::path(options.config);
    const study::StudyPlan plan{.scenarios = study::scenariosOf(config),
                                .minutes = options.minutes,
                                .seeds = options.seeds,
                                .threads = std::max(std::thread::hardware_concurrency(), 1U)};
    const std::vector<study::Sample> samples = watched(plan);
    std::cout << study::studyMarkdown(plan, samples);
    if (options.out.empty()) return;
    writeText(fs::path(options.out) / "adaptation.csv", study::studyCsv(plan, samples));
    writeText(fs::path(options.out) / "adaptation.svg", study::drawStudy(plan, samples));
}

struct ChronicleOptions {
    std::string scene;
    double hours = 1;
    std::uint32_t seed = 1;
};

// Prints what happened as Markdown.
void chronicle(const ChronicleOptions& options) {
    study::Scenario scenario = study::readScenario(options.scene);
    scenario.world.seed = options.seed;
    world::World world(scenario.world);
    constexpr std::uint64_t kTicksOfMinute = 3600;
    constexpr std::uint64_t kTicksOfHour = 60 * kTicksOfMinute;
    study::Chronicle chronicle(world, scenario.halfWidths, kTicksOfHour);
    capture::ProgressBar bar("living");
    const auto ticks = static_cast<std::uint64_t>(options.hours * kTicksOfHour);
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
        world.advance();
        chronicle.note(world);
        if (tick % kTicksOfMinute == 0)
            bar.show(static_cast<double>(tick) / static_cast<double>(ticks));
    }
    std::cout << study::hoursMarkdown(chronicle.hours()) << '\n'
              << study::overlapsMarkdown(
                     chronicle.overlaps(), world, scenario.world.cast, options.hours)
              << "\nhash of the world: " << std::hex << world.hash() << '\n';
}

}  // namespace

}  // namespace aquarama

int main(int count, char** arguments) {
    using namespace aquarama;
    CLI::App app{"With and without each adaptation of the mind to its motor, as tables in Markdown",
                 "aquarama-study"};
    StudyOptions options;
    app.add_option("--out", options.out, "folder for a table of all runs and a figure");
    app.add_option("--minutes", options.minutes, "of each run; 10 when not given")
        ->check(cli::number(0.1, 1440));
    app.add_option("--seeds", options.seeds, "runs of each kind; 5 when not given")
        ->check(cli::wholeNumber(1, 100));
    app.add_option("--config", options.config, "folder that holds scenes and species");
    ChronicleOptions life;
    CLI::App& chronicled =
        *app.add_subcommand("chronicle", "what happens in a scene, hour by hour");
    chronicled.add_option("SCENE", life.scene, "the scene's file")->required();
    chronicled.add_option("--hours", life.hours, "of the scene; 1 when not given")
        ->check(cli::number(0.01, 1000));
    chronicled.add_option("--seed", life.seed, "of the world; 1 when not given")
        ->check(cli::wholeNumber(0, cli::kMostSeed));
    return cli::runProgram(app, count, arguments, [&] {
        if (chronicled.parsed())
            chronicle(life);
        else
            runStudy(options);
        return 0;
    });
}
