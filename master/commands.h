// SPDX-License-Identifier: Apache-2.0
// What the master's program does beside a show, one function a subcommand: each adds its options to
// the command line and what it does to `job`, which returns the exit status.
#pragma once

#include "common/cli/program.h"

namespace aquarama {

void addStatus(CLI::App& app, cli::Job& job);
void addExplain(CLI::App& app, cli::Job& job);
void addPilot(CLI::App& app, cli::Job& job);    // steers the running show from a terminal
void addReplay(CLI::App& app, cli::Job& job);   // compares a recording with its replay
void addInspect(CLI::App& app, cli::Job& job);  // what a recording holds

}  // namespace aquarama
