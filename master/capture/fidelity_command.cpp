// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/cli/outputs.h"
#include "common/files/files.h"
#include "master/capture/commands.h"
#include "master/capture/compile/capture_repertoire.h"
#include "master/capture/compile/config_folder.h"
#include "master/capture/compile/progress_bar.h"
#include "master/capture/compile/repertoire_cache.h"
#include "master/capture/fidelity/fidelity_figures.h"
#include "master/capture/fidelity/fidelity_report.h"

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
    writeWhole(path, std::as_bytes(std::span(text.data(), text.size())));
    std::cerr << path.string() << '\n';
}

void compareAll(const FidelityOptions& options) {
    requireFolder("--out", options.out);
    const fs::path config = options.config.empty() ? findConfigFolder() : fs::path(options.config);
    std::vector<Fidelity> fidelities;
    std::vector<SpeciesVocabularies> vocabularies;
    for (const fs::path& file : speciesFiles(options.species, config)) {
        const Species species = readSpecies(file.string());
        ProgressBar bar("comparing " + species.name);
        const Repertoire repertoire =
            captureRepertoire(species, [&](double share) { bar.show(0.5 * share); });
        fidelities.push_back(measureFidelity(species, repertoire, options.seed, options.seconds));
        bar.show(0.6);
        vocabularies.push_back(
            {species.name,
             compareVocabularies(species, repertoire, options.seed, options.seconds)});
        bar.show(1);
    }
    const fs::path out = options.out;
    writeText(out / "fidelity.html", fidelityPage(fidelities, vocabularies, options.seed));
    writeText(out / "fidelity.csv", fidelityCsv(fidelities));
    writeText(out / "fidelity_ways.svg", drawWaysOfAll(fidelities));
    writeText(out / "fidelity_segments.svg", drawVocabularies(vocabularies));
    std::cout << fidelityMarkdown(fidelities);
}

}  // namespace

void addFidelityCommand(CLI::App& app, Job& job) {
    const auto options = std::make_shared<FidelityOptions>();
    CLI::App& fidelity =
        *app.add_subcommand("fidelity", "how far replicas are from the fish that they stand for");
    fidelity.add_option("--species",
                        options->species,
                        "name of a species in the config folder, or a file; all when not given");
    fidelity.add_option("--seed", options->seed, "which script of commands; 1 when not given")
        ->check(wholeNumber(0, kMostSeed));
    fidelity.add_option("--seconds", options->seconds, "how long the script is; 60 when not given")
        ->check(number(1, 3600));
    fidelity.add_option("--out", options->out, "folder for the page, the table and the pictures")
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
