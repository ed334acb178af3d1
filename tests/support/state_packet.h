// SPDX-License-Identifier: Apache-2.0
// States as a master sends them, from states as a node has them.
#pragma once

#include <cmath>
#include <cstdint>

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

// The packet of a state of the master's run `session`.
inline wire::Packet packetOf(std::uint64_t session, const wire::StateFrame& state) {
    const v1::Show show = messageOf(state.show);
    return wire::encodeState(session,
                             {.frame = state.frame,
                              .tick = state.tick,
                              .fraction = state.fraction,
                              .eye = state.eye,
                              .worldHash = state.worldHash,
                              .motionHash = state.motionHash,
                              .before = state.before,
                              .after = state.after,
                              .foodOriginMetres = state.foodOriginMetres,
                              .foodBefore = state.foodBefore,
                              .foodAfter = state.foodAfter,
                              .timeOfDay = state.timeOfDay,
                              .show = &show});
}

}  // namespace aquarama::test
