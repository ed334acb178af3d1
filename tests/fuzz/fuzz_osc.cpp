// SPDX-License-Identifier: Apache-2.0
#include <span>

#include "common/osc/osc.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

int fuzzOsc(const std::uint8_t* bytes, std::size_t size) {
    const osc::OscPacket packet = osc::decode(std::as_bytes(std::span(bytes, size)));
    promise(packet.messages.size() <= osc::kMostMessages, "messages are few");
    promise(packet.problem.empty() || packet.messages.empty(), "it is read whole or refused");
    promiseLine(packet.problem);
    for (const osc::OscMessage& message : packet.messages) {
        promiseLine(message.address);
        promise(message.arguments.size() <= osc::kMostArguments, "arguments are few");
        const osc::OscPacket again = osc::decode(osc::encode(message));
        promise(again.messages.size() == 1 && again.messages[0].address == message.address &&
                    again.messages[0].arguments.size() == message.arguments.size(),
                "it is read again as it was written");
    }
    return 0;
}

}  // namespace aquarama
