// SPDX-License-Identifier: Apache-2.0
// `aquarama drift`.
#pragma once

namespace aquarama {

// Exit status: 0 all in place, 1 a projector has moved, 2 it cannot be told, errors included.
[[nodiscard]] int runDrift(int count, char** arguments);

}  // namespace aquarama
