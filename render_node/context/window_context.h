// SPDX-License-Identifier: Apache-2.0
// The gamepads of this machine, by GLFW: they may come and go at any time.
#pragma once

#include "render_node/context/context.h"

namespace aquarama::context {

// Of all that are there the one that is moved farthest from rest; at rest where there is none. On
// the main thread, after GLFW was begun.
[[nodiscard]] Pad movedPad();

}  // namespace aquarama::context
