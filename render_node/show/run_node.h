// SPDX-License-Identifier: Apache-2.0
// One node, from joining the show to its end.
#pragma once

#include "render_node/show/node_options.h"

namespace aquarama::show {

// Returns when the show is over or a signal ended this process. Throws Error: what the command line
// asks for cannot be.
void runNode(const NodeOptions& options);

}  // namespace aquarama::show
