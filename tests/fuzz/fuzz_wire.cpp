// SPDX-License-Identifier: Apache-2.0
#include <span>

#include "common/wire/envelope.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

// What is understood says the same when it is said again.
int fuzzWire(const std::uint8_t* bytes, std::size_t size) {
    const auto envelope = decode(std::as_bytes(std::span(bytes, size)));
    if (!envelope) return 0;
    const Packet said = encode(*envelope);
    const auto again = decode(said);
    promise(again.has_value(), "what was decoded can be encoded and decoded");
    promise(encode(*again) == said, "an envelope is encoded in one way");
    return 0;
}

}  // namespace aquarama
