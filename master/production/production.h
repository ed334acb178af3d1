// SPDX-License-Identifier: Apache-2.0
// From files to a world: what a show is made of is read once, as bytes, and the same bytes make the
// world of the show, of its replay and of a study.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/config/rig.h"
#include "common/wire/recording.h"
#include "master/world/world.h"

namespace aquarama {

struct ProductionChoice {
    std::uint32_t seed = 1;
    std::optional<std::uint32_t> fish;  // in the school, instead of the file's number
};

// Reads the files of the rig's cast, whose paths are relative to the rig's; a species that was
// never shown on this machine is captured, behind a bar of progress. Throws Error.
[[nodiscard]] Production readProduction(const Rig& rig,
                                        const std::string& rigPath,
                                        const ProductionChoice& choice);

// Throws Error where a file or a repertoire is wrong. Threads: as many as serve so many fish.
[[nodiscard]] WorldOptions worldOptionsOf(const Production& production);

}  // namespace aquarama
