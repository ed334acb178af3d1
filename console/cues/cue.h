// SPDX-License-Identifier: Apache-2.0
// What a desk says by OSC, as what is wanted of the wall.
#pragma once

#include <string>

#include "common/osc/osc.h"
#include "common/wire/wanted_show.h"

namespace aquarama::console {

// One value that is wanted, or why the message is no cue.
struct Cue {
    v1::WantedShow show = {};
    std::string problem = {};  // one line; empty: none
};

// Of the addresses /aquarama/scene, quality, pattern, black, freeze, guests, drawings, brightness
// and colour, each with one argument.
[[nodiscard]] Cue cueOf(const osc::OscMessage& message);

}  // namespace aquarama::console
