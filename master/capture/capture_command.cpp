// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "master/capture/commands.h"
#include "master/capture/compile/capture_repertoire.h"
#include "master/capture/compile/config_folder.h"
#include "master/capture/compile/progress_bar.h"
#include "master/capture/compile/repertoire_cache.h"
#include "master/capture/report/report.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

struct CaptureOptions {
    std::vector<std::string> species;
    std::string out;
    std::string report;
    std::string config;
};

void capture(const fs::path& speciesFile, const CaptureOptions& options) {
    const Species species = readSpecies(speciesFile.string());
    ProgressBar bar("capturing " + species.name);
    bar.show(0);
    const Repertoire repertoire =
        captureRepertoire(species, [&](double share) { bar.show(share); });
    const fs::path path = fs::path(options.out) / (species.name + ".aqrep");
    writeWhole(path, encodeRepertoire(repertoire));
    std::cout << path.string() << '\n';
    if (!options.report.empty())
        std::cout << writeReport(repertoire, options.report).string() << '\n';
}

void captureAll(const CaptureOptions& options) {
    const fs::path config = options.config.empty() ? findConfigFolder() : fs::path(options.config);
    for (const fs::path& file : speciesFiles(options.species, config)) capture(file, options);
}

}  // namespace

void addCaptureCommand(CLI::App& app) {
    const auto options = std::make_shared<CaptureOptions>();
    app.add_option("--species",
                   options->species,
                   "name of a species in the config folder, or a file; all when not given");
    app.add_option("--out", options->out, "folder for SPECIES.aqrep");
    app.add_option("--report", options->report, "folder for a page with pictures and figures");
    app.add_option("--config", options->config, "folder that holds species/*.txtpb");
    app.callback([&app, options] {
        if (!app.get_subcommands().empty()) return;
        if (options->out.empty()) throw CLI::RequiredError("--out");
        captureAll(*options);
    });
}

}  // namespace aquarama
