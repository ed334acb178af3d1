// SPDX-License-Identifier: Apache-2.0
// The status of a running master as text.
#pragma once

#include <string>

#include "common/wire/messages.h"

namespace aquarama::conductor {

// Where the submarine is, how fast, and who steers it; one line.
[[nodiscard]] std::string submarineText(const v1::StatusReply& status);

// The whole status, a line for each node at the end.
[[nodiscard]] std::string statusText(const v1::StatusReply& status);

}  // namespace aquarama::conductor
