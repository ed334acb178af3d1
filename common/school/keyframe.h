// SPDX-License-Identifier: Apache-2.0
// A keyframe: all of the fish at one tick, and all that the code of the next step depends on. Who
// has it follows the steps after it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "common/school/school_state.h"
#include "common/school/step_codec.h"

namespace aquarama::school {

// What follows from a step on.
struct Keyframe {
    SchoolState school;
    StepMemory memory;
};

// A keyframe as bytes, from the records of all fish at its tick, and back. Nothing where the bytes
// are none of so many fish, or a number is out of bounds. About 52 bytes a fish, and 32 kB.
[[nodiscard]] std::vector<std::byte> encodeKeyframe(Tick tick,
                                                    std::span<const motion::FishRecord> records,
                                                    const motion::MotorCommands& commands,
                                                    const StepMemory& memory);
[[nodiscard]] std::optional<Keyframe> decodeKeyframe(std::span<const std::byte> bytes,
                                                     std::size_t fish);

}  // namespace aquarama::school
