// SPDX-License-Identifier: Apache-2.0
#include <span>

#include "common/wire/messages.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"
#include "tests/support/state_packet.h"

namespace aquarama {

// What is understood says the same when it is said again.
int fuzzWire(const std::uint8_t* bytes, std::size_t size) {
    const auto message = wire::decode(std::as_bytes(std::span(bytes, size)));
    if (!message) return 0;
    const wire::Packet said = wire::encode(message->session(), *message);
    const auto again = wire::decode(said);
    promise(again.has_value(), "what was decoded can be encoded and decoded");
    promise(wire::encode(again->session(), *again) == said, "a message is encoded in one way");
    if (!message->has_state()) return 0;
    const auto state = wire::readState(message->state());
    promise(!state || wire::decode(test::packetOf(1, state->frame, state->school)).has_value(),
            "a state that was read can be encoded and decoded");
    return 0;
}

}  // namespace aquarama
