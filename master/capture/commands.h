// SPDX-License-Identifier: Apache-2.0
// What aquarama-capture can do, one function a subcommand: each adds its options to the command
// line and what it does to `job`, which returns the exit status.
#pragma once

#include "common/cli/program.h"

namespace aquarama {

void addCaptureCommand(CLI::App& app, cli::Job& job);  // the program without a subcommand
void addInspectCommand(CLI::App& app, cli::Job& job);
void addSearchCommand(CLI::App& app, cli::Job& job);
void addGaitsCommand(CLI::App& app, cli::Job& job);
void addExportCommand(CLI::App& app, cli::Job& job);
void addFidelityCommand(CLI::App& app, cli::Job& job);
void addControllersCommand(CLI::App& app, cli::Job& job);

}  // namespace aquarama
