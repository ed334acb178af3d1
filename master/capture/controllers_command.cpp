// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "common/cli/outputs.h"
#include "common/cli/python.h"
#include "master/capture/capture_repertoire.h"
#include "master/capture/commands.h"
#include "master/capture/report/report_data.h"

namespace aquarama {

namespace {

struct ControllersOptions {
    std::string species = "bigeye_scad";
    std::string out;
    std::string config;
};

void draw(const ControllersOptions& options) {
    namespace fs = std::filesystem;
    cli::requireFolder("--out", options.out);
    cli::requirePython({"matplotlib"});
    const fs::path config =
        options.config.empty() ? capture::findConfigFolder() : fs::path(options.config);
    const fs::path file = capture::speciesFiles({options.species}, config).front();
    const fs::path data = report::writeControllers(config::readSpecies(file.string()), options.out);
    cli::runPython({"matplotlib"}, "master/capture/report/draw_controllers.py", {data.string()});
}

}  // namespace

void addControllersCommand(CLI::App& app, cli::Job& job) {
    const auto options = std::make_shared<ControllersOptions>();
    CLI::App& controllers = *app.add_subcommand(
        "controllers",
        "draws what the biomechanical fish does under each of its motor controllers");
    controllers.add_option(
        "--species",
        options->species,
        "name of a species in the config folder, or a file; bigeye_scad when not "
        "given");
    controllers.add_option("--out", options->out, "folder for controllers.svg and its data")
        ->required();
    controllers.add_option("--config", options->config, "folder that holds species/*.txtpb");
    controllers.callback([options, &job] {
        job = [options] {
            draw(*options);
            return 0;
        };
    });
}

}  // namespace aquarama
