// SPDX-License-Identifier: Apache-2.0
// What a desk says by OSC, as an order for the wall.
#pragma once

#include <string>

#include "common/osc/osc.h"
#include "common/wire/messages.h"
#include "common/wire/wanted_show.h"

namespace aquarama::console {

// An order of one value, or why the message is no cue.
struct Cue {
    v1::Order order = {};
    std::string problem = {};  // one line; empty: none
};

// Of the addresses /aquarama/scene, day, release, quality, pattern, black, freeze, guests,
// drawings, brightness and colour, each with one argument.
[[nodiscard]] Cue cueOf(const osc::OscMessage& message);

}  // namespace aquarama::console
