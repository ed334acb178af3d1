// SPDX-License-Identifier: Apache-2.0
// The command `aquarama drift`.
#pragma once

#include "common/cli/commands.h"

namespace aquarama {

// Adds `drift`. Its exit status: 0 all in place, 1 a projector has moved, 2 it cannot be told,
// errors included.
void addDrift(cli::CommandLine& line);

}  // namespace aquarama
