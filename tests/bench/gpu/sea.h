// SPDX-License-Identifier: Apache-2.0
// A living world as the nodes of a wall would be told of it, some ticks long.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/wire/state_codec.h"
#include "render_node/session/session.h"

namespace aquarama::bench {

struct Sea {
    session::Admission admission;          // without a rig
    std::vector<wire::StateFrame> frames;  // half-way between two ticks, as live shows have them
};

// Simulates the scene with so many fish of its first species: first `ticksBefore`, then a frame a
// tick.
[[nodiscard]] Sea makeSea(const std::string& scenePath,
                          std::optional<std::uint32_t> fish,
                          int ticksBefore,
                          int frames);

}  // namespace aquarama::bench
