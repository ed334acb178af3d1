// SPDX-License-Identifier: Apache-2.0
// What aquarama-capture can do: each adds itself to the command line and, when it was asked for,
// runs once that is parsed. Errors are thrown.
#pragma once

namespace CLI {
class App;
}

namespace aquarama {

void addCaptureCommand(CLI::App& app);  // the program without a subcommand
void addInspectCommand(CLI::App& app);
void addSearchCommand(CLI::App& app);
void addGaitsCommand(CLI::App& app);
void addExportCommand(CLI::App& app);
void addFidelityCommand(CLI::App& app);
void addControllersCommand(CLI::App& app);

}  // namespace aquarama
