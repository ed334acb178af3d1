// SPDX-License-Identifier: Apache-2.0
// What a node tells the master of its machine, and what the master may do with it: power it off or
// restart it.
#pragma once

#include <string>

#include "common/wire/messages.h"
#include "render_node/session/session.h"

namespace aquarama::session {

// Host, build, graphics, monitors, state of the clock, and whether the machine takes a power word.
void reportMachine(const NodeFacts& facts, v1::NodeReport& report);

// Hands the order to the service of the machine, which then ends this node in an orderly way. The
// reply says why where it is refused.
[[nodiscard]] v1::Envelope switchMachine(const v1::Order& order);

// As text in a packet may be: control characters become blanks, what is no UTF-8 is shown as bytes,
// and it is cut to so many bytes.
[[nodiscard]] std::string printable(std::string text, std::size_t mostBytes = wire::kMostLogBytes);

}  // namespace aquarama::session
