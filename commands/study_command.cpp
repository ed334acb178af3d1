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

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "capture/capture_repertoire.h"
#include "commands/commands.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/movement_versions.h"
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
};

// The folder for the data: the requested one, or a temporary one that is removed with this object.
class DataFolder {
  public:
    // Call it before the work. Throws Error where the folder cannot be written or Python is
    // missing.
    static void require(const std::string& asked) {
        cli::requireFolder("--out", asked);
        cli::requirePython(kModules);
    }
    explicit DataFolder(const std::string& asked) : path_(asked), isKept_(!asked.empty()) {
        if (isKept_) return;
        made_.emplace("study");
        path_ = made_->path();
    }

    // Prints the file's name on stderr where it is kept: stdout is for the tables.
    void write(const std::string& name, const std::string& text) const {
        writeWhole(path_ / name, std::as_bytes(std::span(text)));
        if (isKept_) std::cerr << (path_ / name).string() << '\n';
    }
    [[nodiscard]] bool isKept() const { return isKept_; }
    // Prints the tables: "adaptation", and with "figure" draws it beside the data; or "chronicle"
    // and its hours.
    void show(const std::string& what, const std::string& more) const {
        cli::runPython(kModules, "master/study/draw_study.py", {what, path_.string(), more}, path_);
    }

  private:
    inline static const std::vector<std::string> kModules{"matplotlib", "scipy"};
    fs::path path_;
    bool isKept_;
    std::optional<TemporaryFolder> made_;
};

// The line by which docs/studies.py knows what moved the fish.
std::string versionsLine() {
    return fmt::format("motor {}, minds {}\n", kMotorVersion, kMindsVersion);
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
    DataFolder::require(options.out);
    const fs::path config = configFolder(options.config);
    const study::StudyPlan plan{.scenarios = study::scenariosOf(config),
                                .minutes = options.minutes,
                                .seeds = options.seeds,
                                .threads = std::max(std::thread::hardware_concurrency(), 1U)};
    const std::string runs = study::runsCsv(plan, watched(plan));
    const DataFolder folder(options.out);
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
    DataFolder::require(options.out);
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
    const DataFolder folder(options.out);
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
                               "of a scene in figures",
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
}

}  // namespace aquarama
