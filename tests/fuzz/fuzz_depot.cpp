// SPDX-License-Identifier: Apache-2.0
#include <span>

#include "releases/messages.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

// What is understood says the same when it is said again.
int fuzzDepot(const std::uint8_t* bytes, std::size_t size) {
    const auto message = releases::decode(std::as_bytes(std::span(bytes, size)));
    if (!message) return 0;
    const auto said = releases::encode(*message);
    const auto again = releases::decode(said);
    promise(again.has_value(), "what was decoded can be encoded and decoded");
    promise(releases::encode(*again) == said, "a message is encoded in one way");
    promise(releases::reportIn(message->report()).held.size() <= 64, "a report holds few releases");
    return 0;
}

}  // namespace aquarama
