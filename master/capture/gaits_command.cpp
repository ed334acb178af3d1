// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "master/capture/capture_repertoire.h"
#include "master/capture/commands.h"
#include "master/capture/gait_trial.h"

namespace aquarama {

namespace {

struct GaitsOptions {
    std::vector<std::string> species;
    std::string config;
};

void printGaits(const GaitsOptions& options) {
    const std::filesystem::path config = options.config.empty()
                                             ? capture::findConfigFolder()
                                             : std::filesystem::path(options.config);
    const auto files = capture::speciesFiles(options.species, config);
    std::cout << capture::gaitTableHead();
    for (const auto& file : files)
        std::cout << capture::gaitTableRows(config::readSpecies(file.string())) << std::flush;
    std::cout << '\n' << capture::turnTableHead();
    for (const auto& file : files)
        std::cout << capture::turnTableRow(config::readSpecies(file.string())) << std::flush;
}

}  // namespace

void addGaitsCommand(CLI::App& app, cli::Job& job) {
    const auto options = std::make_shared<GaitsOptions>();
    CLI::App& command =
        *app.add_subcommand("gaits", "how species swim and turn, as tables in Markdown");
    command.add_option("SPECIES", options->species, "names or files; all when none is given");
    command.add_option("--config", options->config, "folder that holds species/*.txtpb");
    command.callback([options, &job] {
        job = [options] {
            printGaits(*options);
            return 0;
        };
    });
}

}  // namespace aquarama
