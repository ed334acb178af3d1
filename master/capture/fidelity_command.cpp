// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/cli/outputs.h"
#include "common/cli/python.h"
#include "common/files/files.h"
#include "master/capture/capture_repertoire.h"
#include "master/capture/commands.h"
#include "master/capture/report/fidelity.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

struct FidelityOptions {
    std::vector<std::string> species;
    std::string out;
    std::string config;
    std::uint64_t seed = 1;
    double seconds = 60;
};

void writeText(const fs::path& path, const std::string& text) {
    files::writeWhole(path, std::as_bytes(std::span(text.data(), text.size())));
    std::cerr << path.string() << '\n';
}

void compareAll(const FidelityOptions& options) {
    cli::requireFolder("--out", options.out);
    cli::requirePython({"matplotlib"});
    const fs::path config =
        options.config.empty() ? capture::findConfigFolder() : fs::path(options.config);
    std::vector<report::Fidelity> fidelities;
    std::vector<report::SpeciesVocabularies> vocabularies;
    for (const fs::path& file : capture::speciesFiles(options.species, config)) {
        const config::Species species = config::readSpecies(file.string());
        capture::ProgressBar bar("comparing " + species.name);
        const motion::Repertoire repertoire =
            capture::captureRepertoire(species, [&](double share) { bar.show(0.5 * share); });
        fidelities.push_back(
            report::measureFidelity(species, repertoire, options.seed, options.seconds));
        bar.show(0.6);
        vocabularies.push_back(
            {species.name,
             report::compareVocabularies(species, repertoire, options.seed, options.seconds)});
        bar.show(1);
    }
    const fs::path out = options.out;
    writeText(out / "fidelity.csv", report::commandsCsv(fidelities));
    writeText(out / "fidelity_summaries.csv", report::summariesCsv(fidelities));
    writeText(out / "fidelity_ticks.csv", report::ticksCsv(fidelities));
    writeText(out / "fidelity_vocabularies.csv", report::vocabulariesCsv(vocabularies));
    cli::runPython({"matplotlib"},
                   "master/capture/report/draw_fidelity.py",
                   {options.out, std::to_string(options.seed)});
}

}  // namespace

void addFidelityCommand(CLI::App& app, cli::Job& job) {
    const auto options = std::make_shared<FidelityOptions>();
    CLI::App& fidelity =
        *app.add_subcommand("fidelity", "how far replicas are from the fish that they stand for");
    fidelity.add_option("--species",
                        options->species,
                        "name of a species in the config folder, or a file; all when not given");
    fidelity.add_option("--seed", options->seed, "which script of commands; 1 when not given")
        ->check(cli::wholeNumber(0, cli::kMostSeed));
    fidelity.add_option("--seconds", options->seconds, "how long the script is; 60 when not given")
        ->check(cli::number(1, 3600));
    fidelity.add_option("--out", options->out, "folder for the page, its data and the pictures")
        ->required();
    fidelity.add_option("--config", options->config, "folder that holds species/*.txtpb");
    fidelity.callback([options, &job] {
        job = [options] {
            compareAll(*options);
            return 0;
        };
    });
}

}  // namespace aquarama
