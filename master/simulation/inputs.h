// SPDX-License-Identifier: Apache-2.0
// What reaches the world, as a recording has it, and back.
#pragma once

#include "common/wire/recording.h"
#include "master/world/input.h"

namespace aquarama::simulation {

[[nodiscard]] wire::RecordedInput recorded(Tick tick, const world::WorldInput& input);
[[nodiscard]] world::WorldInput inputOf(const wire::RecordedInput& recorded);

}  // namespace aquarama::simulation
