// SPDX-License-Identifier: Apache-2.0
// How the console begins to listen to desks and trackers.
#pragma once

#include <functional>
#include <string>

#include "common/config/host.h"

namespace aquarama::console {

// Opens a port, and says so in the log: "cues by OSC at udp://127.0.0.1:7500". Where `open` throws
// Error, `problem` says why, and the log has it once for all tries; else `problem` is empty.
void listenTo(const char* what,
              const config::UdpAddress& where,
              std::string& problem,
              const std::function<void()>& open);

}  // namespace aquarama::console
