// SPDX-License-Identifier: Apache-2.0
// What reaches the world, as a recording has it, and back.
#pragma once

#include "common/wire/recording.h"
#include "master/world/input.h"

namespace aquarama {

[[nodiscard]] RecordedInput recorded(Tick tick, const WorldInput& input);
[[nodiscard]] WorldInput inputOf(const RecordedInput& recorded);

}  // namespace aquarama
