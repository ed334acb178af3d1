// SPDX-License-Identifier: Apache-2.0
// What the driver has to say about our mistakes.
#pragma once

namespace aquarama::gl {

// Writes the driver's errors and warnings to the log from now on, for the current context.
void logMessages();

}  // namespace aquarama::gl
