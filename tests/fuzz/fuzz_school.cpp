// SPDX-License-Identifier: Apache-2.0
#include <span>

#include "common/school/keyframe.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

// A keyframe of one fish that is read can be written, and any bytes are a step or none.
int fuzzSchool(const std::uint8_t* bytes, std::size_t size) {
    const auto input = std::as_bytes(std::span(bytes, size));
    constexpr std::size_t kFish = 1;
    auto keyframe = school::decodeKeyframe(input, kFish);
    if (keyframe) {
        std::vector<motion::FishRecord> records;
        keyframe->school.records(records);
        const auto again = school::encodeKeyframe(
            keyframe->school.tick, records, keyframe->school.commands, keyframe->memory);
        promise(std::ranges::equal(again, input), "a keyframe is encoded in one way");
    }
    constexpr std::size_t kSchool = 24;
    school::StepMemory memory = school::makeStepMemory({}, kSchool);
    motion::MotorCommands commands;
    commands.resize(kSchool);
    const auto placed = school::decodeStep({1}, input, commands, memory);
    for (const std::uint8_t action : commands.action)
        promise(action < motion::kActions, "a command is one that the motor plays");
    promise(!placed || placed->size() <= kSchool, "no more fish are placed than there are");
    return 0;
}

}  // namespace aquarama
