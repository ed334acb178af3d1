// SPDX-License-Identifier: Apache-2.0
#include <iostream>
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

struct InspectOptions {
    std::string file;
    std::string report;
};

void inspect(const InspectOptions& options) {
    cli::requireFolder("--report", options.report);
    if (!options.report.empty()) cli::requirePython({"matplotlib"});
    const std::vector<std::byte> bytes = capture::readRepertoireFile(options.file);
    std::cout << report::inspectRepertoire(bytes, options.file);
    if (options.report.empty()) return;
    const motion::Repertoire repertoire = motion::decodeRepertoire(bytes, options.file);
    const std::string data = report::writeReport(repertoire, options.report).string();
    std::cout << '\n';
    cli::runPython({"matplotlib"}, "master/capture/report/draw_report.py", {data});
}

}  // namespace

void addInspectCommand(CLI::App& app, cli::Job& job) {
    const auto options = std::make_shared<InspectOptions>();
    CLI::App& command = *app.add_subcommand("inspect", "what a repertoire holds");
    command.add_option("FILE", options->file, "a repertoire")->required();
    command.add_option("--report", options->report, "folder for a page with pictures and figures");
    command.callback([options, &job] {
        job = [options] {
            inspect(*options);
            return 0;
        };
    });
}

}  // namespace aquarama
