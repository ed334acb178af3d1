// SPDX-License-Identifier: Apache-2.0
// `aquarama gaits`, `search` and `controllers`: measure how species swim.
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "capture/capture_repertoire.h"
#include "capture/gait_trial.h"
#include "capture/report/report_data.h"
#include "capture/search.h"
#include "capture/start_figures.h"
#include "commands/commands.h"
#include "common/base/files.h"
#include "common/cli/outputs.h"
#include "common/cli/progress.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

struct GaitsOptions {
    std::vector<std::string> species;  // names or files; none: all
    std::string config;
};

// Prints a line as soon as its species is measured.
void printGaits(const GaitsOptions& options) {
    const fs::path config = configFolder(options.config);
    const auto files = capture::speciesFiles(options.species, config);
    std::cout << capture::gaitTableHead();
    for (const auto& file : files)
        std::cout << capture::gaitTableRows(config::readSpecies(file.string())) << std::flush;
    std::cout << '\n' << capture::turnTableHead();
    for (const auto& file : files)
        std::cout << capture::turnTableRow(config::readSpecies(file.string())) << std::flush;
    std::cout << '\n' << capture::startTableHead();
    for (const auto& file : files)
        std::cout << capture::startTableRows(config::readSpecies(file.string())) << std::flush;
}

// Options of `search`. The journal lies beside `out`.
struct SearchOptions {
    std::string species;
    std::string out;
    std::string config;
    std::size_t trials = 1000;
};

// The bytes of the whole file; empty where it cannot be read.
std::string textOf(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// The best trial so far, for the progress bar.
std::string told(std::size_t trials, const capture::SearchTrial& best) {
    std::ostringstream note;
    note << std::fixed << std::setprecision(2) << "trial " << trials << ", Strouhal "
         << best.leastStrouhal << "-" << best.mostStrouhal << ", stride " << best.leastStride << "-"
         << best.mostStride << ", miss " << best.miss;
    return note.str();
}

// Continues where the journal ends; then chooses the strength of turns and writes the species' text
// with the results.
void searchGaitsOf(const SearchOptions& options) {
    cli::requireFile("--out", options.out);
    const fs::path file =
        capture::speciesFiles({options.species}, configFolder(options.config)).front();
    const std::string text = textOf(file);
    const config::Species species = config::parseSpecies(text, file.string());
    capture::SearchJournal journal(options.out + ".journal", capture::searchName(text));
    cli::Progress bar("searching " + species.name);
    const capture::SearchTrial best = capture::searchGaits(
        species,
        options.trials,
        journal,
        [&](std::size_t trials, const capture::SearchTrial& soFar) {
            bar.show(static_cast<double>(trials) / static_cast<double>(options.trials),
                     told(trials, soFar));
        });
    bar.show(1, told(journal.trials().size(), best));

    config::Species swimmer = capture::speciesAt(best.point, species);
    swimmer.turn = capture::withFittingStrengths(swimmer);
    const std::string found = capture::withGaitsOf(swimmer, text);
    writeWhole(options.out, std::as_bytes(std::span(found)));
    std::cout << options.out << "\n\n"
              << capture::gaitTableHead()
              << capture::gaitTableRows(config::parseSpecies(found, options.out));
}

struct ControllersOptions {
    std::string species = "bigeye_scad";
    std::string out;
    std::string config;
};

// Measures each controller and has Python draw the sheet.
void drawControllers(const ControllersOptions& options) {
    cli::requireFolder("--out", options.out);
    cli::requirePython({"matplotlib"});
    const fs::path config = configFolder(options.config);
    const fs::path file = capture::speciesFiles({options.species}, config).front();
    const fs::path data = report::writeControllers(config::readSpecies(file.string()), options.out);
    cli::runPython(
        {"matplotlib"}, "capture/report/draw_controllers.py", {data.string()}, options.out);
}

}  // namespace

void addGaits(CommandLine& line) {
    const auto [command, options] = line.add<GaitsOptions>(
        "gaits", "how species swim, turn and start, as tables in Markdown", printGaits);
    command.add_option("SPECIES", options.species, "names or files; all when none is given");
    describeConfig(command, options.config);
}

void addSearch(CommandLine& line) {
    const auto [command, options] = line.add<SearchOptions>(
        "search", "find gait parameters with which a species swims", searchGaitsOf);
    command.add_option("SPECIES", options.species, "a name in the config folder, or a file")
        ->required();
    command
        .add_option(
            "--out",
            options.out,
            "the species file to write; beside it FILE.journal, with which the same command "
            "goes on where it was interrupted")
        ->required();
    command.add_option("--trials", options.trials, "the most to make")
        ->check(cli::wholeNumber(1, 1'000'000))
        ->capture_default_str();
    describeConfig(command, options.config);
}

void addControllers(CommandLine& line) {
    const auto [command, options] = line.add<ControllersOptions>(
        "controllers",
        "draw the biomechanical fish under each of its motor controllers",
        drawControllers);
    command
        .add_option(
            "--species", options.species, "name of a species in the config folder, or a file")
        ->capture_default_str();
    command.add_option("--out", options.out, "folder for controllers.svg and its data")->required();
    describeConfig(command, options.config);
}

}  // namespace aquarama
