// SPDX-License-Identifier: Apache-2.0
// `aquarama touch`: where the plane of a tracker is before the wall, by three marks of the grid.
#pragma once

#include <string>
#include <vector>

#include "common/cli/commands.h"

namespace aquarama::console {

// What its command line says; empty where an option was not given.
struct TouchOptions {
    std::string rig, master, key, listen;
    std::vector<std::string> from;
    bool arePeople = false, writes = false;
    double share = 0.8;
};

// Adds the command.
void addTouch(cli::CommandLine& line);

}  // namespace aquarama::console
