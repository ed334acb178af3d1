// SPDX-License-Identifier: Apache-2.0
// aquarama-capture: captures the repertoires of species, says what they hold, exports it, finds
// gaits and compares replicas with the fish.
#include <exception>
#include <iostream>

#include <CLI/CLI.hpp>

#include "master/capture/commands.h"

int main(int count, char** arguments) {
    CLI::App app{
        "Simulates the biomechanical fish of each species and compiles its repertoire of actions"};
    app.require_subcommand(0, 1);
    try {
        aquarama::addCaptureCommand(app);
        aquarama::addInspectCommand(app);
        aquarama::addSearchCommand(app);
        aquarama::addGaitsCommand(app);
        aquarama::addExportCommand(app);
        aquarama::addFidelityCommand(app);
        aquarama::addControllersCommand(app);
        app.parse(count, arguments);
        return 0;
    } catch (const CLI::ParseError& wrong) {
        return app.exit(wrong) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        std::cerr << "aquarama-capture: " << error.what() << '\n';
        return 1;
    }
}
