// SPDX-License-Identifier: Apache-2.0
// aquarama-capture: captures the repertoires of species, says what they hold, exports it, finds
// gaits and compares replicas with the fish.
#include <CLI/CLI.hpp>

#include "common/cli/program.h"
#include "master/capture/commands.h"

int main(int count, char** arguments) {
    using namespace aquarama;
    CLI::App app{
        "Simulates the biomechanical fish of each species and compiles its repertoire of actions",
        "aquarama-capture"};
    app.require_subcommand(0, 1);
    cli::Job job;
    for (const auto add : {addCaptureCommand,
                           addInspectCommand,
                           addSearchCommand,
                           addGaitsCommand,
                           addExportCommand,
                           addFidelityCommand,
                           addControllersCommand})
        add(app, job);
    return cli::runProgram(app, count, arguments, [&] { return job(); });
}
