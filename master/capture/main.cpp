// SPDX-License-Identifier: Apache-2.0
// aquarama-capture: captures the repertoires of species, and says what a repertoire holds.
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/motion/repertoire.h"
#include "master/capture/capture_repertoire.h"
#include "master/capture/config_folder.h"
#include "master/capture/inspect.h"
#include "master/capture/progress_bar.h"
#include "master/capture/repertoire_cache.h"
#include "master/capture/report.h"

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
        std::cout << writeReport(repertoire, makeBody(species), options.report).string() << '\n';
}

void captureAll(const CaptureOptions& options) {
    const fs::path config = options.config.empty() ? findConfigFolder() : fs::path(options.config);
    for (const fs::path& file : speciesFiles(options.species, config)) capture(file, options);
}

int run(int count, char** arguments) {
    CLI::App app{
        "Simulates the biomechanical fish of each species and compiles its repertoire of actions"};
    CaptureOptions options;
    app.add_option("--species",
                   options.species,
                   "name of a species in the config folder, or a file; all when not given");
    app.add_option("--out", options.out, "folder for SPECIES.aqrep");
    app.add_option("--report", options.report, "folder for a page with pictures and figures");
    app.add_option("--config", options.config, "folder that holds species/*.txtpb");
    app.require_subcommand(0, 1);
    std::string file;
    CLI::App& inspect = *app.add_subcommand("inspect", "what a repertoire holds");
    inspect.add_option("FILE", file, "a repertoire")->required();
    try {
        app.parse(count, arguments);
        if (!inspect.parsed() && options.out.empty()) throw CLI::RequiredError("--out");
    } catch (const CLI::ParseError& wrong) {
        return app.exit(wrong) == 0 ? 0 : 2;
    }
    if (inspect.parsed())
        std::cout << inspectRepertoire(readWhole(file), file);
    else
        captureAll(options);
    return 0;
}

}  // namespace

}  // namespace aquarama

int main(int count, char** arguments) {
    try {
        return aquarama::run(count, arguments);
    } catch (const std::exception& error) {
        std::cerr << "aquarama-capture: " << error.what() << '\n';
        return 1;
    }
}
