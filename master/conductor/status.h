// SPDX-License-Identifier: Apache-2.0
// The running wall in the terminal.
#pragma once

#include <string>

#include "common/wire/envelope.h"

namespace aquarama::conductor {

// Where the submarine is, how fast, and who steers it; one line.
[[nodiscard]] std::string submarineText(const wire::StatusReply& status);

[[nodiscard]] std::string statusText(const wire::StatusReply& status);

// Asks the master at this control address. Throws Error where none answers.
[[nodiscard]] std::string runStatus(const std::string& controlAddress);

}  // namespace aquarama::conductor
