// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/cli/outputs.h"
#include "common/files/files.h"
#include "common/units/log.h"
#include "master/capture/capture_repertoire.h"
#include "master/capture/commands.h"
#include "master/capture/report/c3d.h"
#include "master/capture/report/gltf.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

struct ExportOptions {
    std::string file;
    std::string segment;
    int cycles = 1;
    std::string c3d, gltf, csv;  // where to; one is asked for
    std::string config;
};

std::vector<std::string> segmentNames() {
    std::vector<std::string> names;
    names.reserve(motion::kCapturedActions);
    for (int i = 0; i < motion::kCapturedActions; ++i)
        names.emplace_back(motion::nameOf(static_cast<motion::Action>(i)));
    return names;
}

motion::Action actionNamed(const std::string& segment) {
    const std::vector<std::string> names = segmentNames();
    return static_cast<motion::Action>(std::ranges::find(names, segment) - names.begin());
}

report::GltfContainer containerOf(const fs::path& path) {
    if (path.extension() == ".glb") return report::GltfContainer::Binary;
    if (path.extension() == ".gltf") return report::GltfContainer::Text;
    throw Error(path.string() + ": name it .glb (binary) or .gltf (text)");
}

// The skin is not in the repertoire but in the species' file.
body::FishBody bodyOf(const motion::Repertoire& repertoire, const ExportOptions& options) {
    const fs::path config =
        options.config.empty() ? capture::findConfigFolder() : fs::path(options.config);
    return body::makeBody(
        config::readSpecies(capture::speciesFiles({repertoire.species}, config).front().string()));
}

void exportSegment(const ExportOptions& options) {
    cli::requireFile("--c3d", options.c3d);
    cli::requireFile("--gltf", options.gltf);
    cli::requireFile("--csv", options.csv);
    const motion::Action action = actionNamed(options.segment);
    const motion::Repertoire repertoire =
        motion::decodeRepertoire(capture::readRepertoireFile(options.file), options.file);
    if (!options.gltf.empty()) {
        const report::GltfContainer container = containerOf(options.gltf);
        const body::FishBody body = bodyOf(repertoire, options);
        files::writeWhole(options.gltf,
                          report::gltfOf(repertoire, body, action, options.cycles, container));
        return;
    }
    const report::Take take = report::takeAtTicks(repertoire, action, options.cycles);
    if (options.csv.empty()) {
        files::writeWhole(options.c3d, report::c3dOf(take));
    } else {
        const std::string rows = report::csvOf(take);
        files::writeWhole(options.csv, std::as_bytes(std::span(rows)));
    }
}

}  // namespace

void addExportCommand(CLI::App& app, cli::Job& job) {
    const auto options = std::make_shared<ExportOptions>();
    CLI::App& command = *app.add_subcommand(
        "export", "a segment for other programs: metres, Y up, from the origin along +x");
    command.add_option("FILE", options->file, "a repertoire")->required();
    command.add_option("--segment", options->segment, "which")
        ->required()
        ->check(CLI::IsMember(segmentNames()));
    command.add_option("--cycles", options->cycles, "how often it is repeated")
        ->check(cli::wholeNumber(1, report::kMostCycles))
        ->capture_default_str();
    CLI::Option_group& out = *command.add_option_group("format", "one of");
    out.add_option("--c3d", options->c3d, "nodal points as markers, 60 frames a second");
    out.add_option("--csv", options->csv, "nodal points as a table, 60 rows a second");
    out.add_option("--gltf", options->gltf, "the skin, swimming: a .glb or .gltf file");
    out.require_option(1);
    command.add_option(
        "--config", options->config, "folder that holds species/*.txtpb, for --gltf");
    command.callback([options, &job] {
        job = [options] {
            exportSegment(*options);
            return 0;
        };
    });
}

}  // namespace aquarama
