// SPDX-License-Identifier: Apache-2.0
#include <span>

#include "common/wire/envelope.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

// What is understood says the same when it is said again.
int fuzzWire(const std::uint8_t* bytes, std::size_t size) {
    const auto envelope = wire::decode(std::as_bytes(std::span(bytes, size)));
    if (!envelope) return 0;
    const wire::Packet said = wire::encode(*envelope);
    const auto again = wire::decode(said);
    promise(again.has_value(), "what was decoded can be encoded and decoded");
    promise(wire::encode(*again) == said, "an envelope is encoded in one way");
    return 0;
}

}  // namespace aquarama
