// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <memory>
#include <span>
#include <sstream>
#include <string>

#include <CLI/CLI.hpp>

#include "common/cli/outputs.h"
#include "common/files/files.h"
#include "master/capture/capture_repertoire.h"
#include "master/capture/commands.h"
#include "master/capture/gait_trial.h"
#include "master/capture/search.h"
#include "master/capture/species_text.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

struct SearchOptions {
    std::string species;
    std::string out;
    std::string config;
    std::size_t trials = 1000;
};

fs::path configFolder(const std::string& given) {
    return given.empty() ? capture::findConfigFolder() : fs::path(given);
}

std::string textOf(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string told(std::size_t trials, const capture::SearchTrial& best) {
    std::ostringstream note;
    note << std::fixed << std::setprecision(2) << "trial " << trials << ", Strouhal "
         << best.leastStrouhal << "-" << best.mostStrouhal << ", stride " << best.leastStride << "-"
         << best.mostStride << ", miss " << best.miss;
    return note.str();
}

void searchGaitsOf(const SearchOptions& options) {
    cli::requireFile("--out", options.out);
    const fs::path file =
        capture::speciesFiles({options.species}, configFolder(options.config)).front();
    const std::string text = textOf(file);
    const config::Species species = config::parseSpecies(text, file.string());
    capture::SearchJournal journal(options.out + ".journal", capture::searchName(text));
    capture::ProgressBar bar("searching " + species.name);
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
    files::writeWhole(options.out, std::as_bytes(std::span(found)));
    std::cout << options.out << "\n\n"
              << capture::gaitTableHead()
              << capture::gaitTableRows(config::parseSpecies(found, options.out));
}

}  // namespace

void addSearchCommand(CLI::App& app, cli::Job& job) {
    const auto options = std::make_shared<SearchOptions>();
    CLI::App& command =
        *app.add_subcommand("search", "find gait parameters with which a species swims");
    command.add_option("SPECIES", options->species, "a name in the config folder, or a file")
        ->required();
    command
        .add_option(
            "--out",
            options->out,
            "the species file to write; beside it FILE.journal, with which the same command "
            "goes on where it was interrupted")
        ->required();
    command.add_option("--trials", options->trials, "the most to make")
        ->check(cli::wholeNumber(1, 1'000'000))
        ->capture_default_str();
    command.add_option("--config", options->config, "folder that holds species/*.txtpb");
    command.callback([options, &job] {
        job = [options] {
            searchGaitsOf(*options);
            return 0;
        };
    });
}

}  // namespace aquarama
