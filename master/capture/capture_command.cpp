// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/cli/outputs.h"
#include "common/cli/python.h"
#include "common/cli/signals.h"
#include "common/files/files.h"
#include "common/units/log.h"
#include "master/capture/capture_repertoire.h"
#include "master/capture/commands.h"
#include "master/capture/report/report_data.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

struct CaptureOptions {
    std::vector<std::string> species;
    std::string out;
    std::string report;
    std::string config;
};

std::vector<capture::RepertoireFile> captured(const std::vector<config::Species>& species) {
    std::atomic<bool> isStopped = false;
    const cli::SignalWatch watch([&] { isStopped = true; });
    capture::ProgressBar bar("capturing");
    return capture::repertoiresFor(species,
                                   files::cacheFolder() / "repertoires",
                                   {.progress = [&](double share) { bar.show(share); },
                                    .isStopped = [&] { return isStopped.load(); }});
}

// With the data of its report, where one is asked for; returns their path.
fs::path write(const capture::RepertoireFile& file, const CaptureOptions& options) {
    const fs::path path = fs::path(options.out) / (file.species + ".aqrep");
    files::writeWhole(path, file.bytes);
    std::cout << path.string() << '\n';
    if (options.report.empty()) return {};
    const motion::Repertoire repertoire = motion::decodeRepertoire(file.bytes, path.string());
    return report::writeReport(repertoire, options.report);
}

// A species that fails is named, and the others still come out. Returns the exit status.
int captureAll(const CaptureOptions& options) {
    cli::holdSignals();
    cli::requireFolder("--out", options.out);
    cli::requireFolder("--report", options.report);
    if (!options.report.empty()) cli::requirePython({"matplotlib"});
    const fs::path config =
        options.config.empty() ? capture::findConfigFolder() : fs::path(options.config);
    int status = 0;
    const auto fail = [&](const std::string& why) {
        cli::sayError("aquarama-capture", why);
        status = 1;
    };
    std::vector<config::Species> species;
    for (const fs::path& file : capture::speciesFiles(options.species, config)) try {
            species.push_back(config::readSpecies(file.string()));
        } catch (const Error& error) {
            fail(error.what());
        }
    std::vector<std::string> reports;
    for (const capture::RepertoireFile& file : captured(species)) {
        if (file.error.empty())
            reports.push_back(write(file, options));
        else
            fail(file.error);
    }
    if (!options.report.empty() && !reports.empty())
        cli::runPython({"matplotlib"}, "master/capture/report/draw_report.py", reports);
    return status;
}

}  // namespace

void addCaptureCommand(CLI::App& app, cli::Job& job) {
    const auto options = std::make_shared<CaptureOptions>();
    app.add_option("--species",
                   options->species,
                   "name of a species in the config folder, or a file; all when not given");
    app.add_option("--out", options->out, "folder for SPECIES.aqrep");
    app.add_option("--report", options->report, "folder for a page with pictures and figures");
    app.add_option("--config", options->config, "folder that holds species/*.txtpb");
    job = [options] {
        if (options->out.empty()) throw CLI::RequiredError("--out");
        return captureAll(*options);
    };
}

}  // namespace aquarama
