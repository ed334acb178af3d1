// SPDX-License-Identifier: Apache-2.0
// States as a master sends them, from states as a node has them.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "common/school/keyframe.h"
#include "common/wire/messages.h"
#include "common/wire/state_codec.h"

namespace aquarama::test {

inline v1::Show messageOf(const wire::Show& show) {
    v1::Show message;
    message.set_version(show.version);
    message.set_look(show.look);
    message.set_scene(show.scene);
    message.set_quality(static_cast<std::uint32_t>(show.quality));
    message.set_pattern(static_cast<v1::Pattern>(show.pattern));
    message.set_black(show.black);
    message.set_colour_returned(
        static_cast<std::uint32_t>(std::lround(wire::kAllColour * show.colourReturned)));
    message.set_brightness(static_cast<std::uint32_t>(std::lround(255 * show.brightness)));
    message.set_frozen(show.frozen);
    message.set_pilot(show.pilot);
    message.set_calibration(show.calibration);
    if (show.sign.columns > 0) {
        message.mutable_sign()->set_columns(show.sign.columns);
        message.mutable_sign()->set_rows(show.sign.rows);
        message.mutable_sign()->set_dots(show.sign.dots);
    }
    if (show.skins) message.set_skins(wire::bytesOf(*show.skins));
    if (show.scan) wire::writeScanPattern(*show.scan, *message.mutable_scan());
    return message;
}

// The fish of a state as a stream of its own: a keyframe, and a step that places all of them where
// the frame lies between two ticks.
inline wire::SchoolPart schoolOf(const wire::StateFrame& state) {
    const bool isBetween = !state.before.empty();
    const std::vector<motion::FishRecord>& first = isBetween ? state.before : state.after;
    motion::MotorCommands commands;
    commands.resize(first.size());
    school::StepMemory memory = school::makeStepMemory({}, first.size());
    const Tick tick{state.tick.value - (isBetween ? 1 : 0)};
    wire::SchoolPart part{
        state.frame.value + 1, school::encodeKeyframe(tick, first, commands, memory), {}};
    if (!isBetween) return part;
    std::vector<school::PlacedFish> placed;
    for (const motion::FishRecord& record : state.after)
        placed.push_back({static_cast<std::uint32_t>(placed.size()), record});
    const motion::MotorCommands same = commands;
    part.steps.push_back(
        {state.tick, school::encodeStep(state.tick, same, placed, commands, memory), {}});
    return part;
}

// The packet of a state of the master's run `session`: of a frame and this part of a stream, or of
// a frame with its fish.
inline wire::Packet packetOf(std::uint64_t session,
                             const wire::StateFrame& state,
                             const wire::SchoolPart& school) {
    const v1::Show show = messageOf(state.show);
    return wire::encodeState(session,
                             {.frame = state.frame,
                              .tick = state.tick,
                              .fraction = state.fraction,
                              .eye = state.eye,
                              .worldHash = state.worldHash,
                              .foodOriginMetres = state.foodOriginMetres,
                              .foodBefore = state.foodBefore,
                              .foodAfter = state.foodAfter,
                              .timeOfDay = state.timeOfDay,
                              .show = &show},
                             school);
}
inline wire::Packet packetOf(std::uint64_t session, const wire::StateFrame& state) {
    return packetOf(session, state, schoolOf(state));
}

}  // namespace aquarama::test
