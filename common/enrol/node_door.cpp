// SPDX-License-Identifier: Apache-2.0
#include "common/enrol/node_door.h"

#include <chrono>
#include <cstdint>

#include "common/base/log.h"
#include "common/base/typed_code.h"

namespace aquarama::enrol {

namespace {

// "tcp://0.0.0.0:41234"
std::uint16_t portOf(const std::string& address) {
    return static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1)));
}

}  // namespace

// No state is published: its socket stays within the machine.
NodeDoor::NodeDoor(const WaitingNode::Keep& keep)
    : channels_{net::bindMaster("tcp://0.0.0.0:*",
                                "tcp://127.0.0.1:*",
                                {.toMaster = kMostWordBytes, .toNode = kMostWordBytes},
                                net::MasterKeys{own_, {}})},
      node_{own_.publicKey, net::monotonicNow(), keep},
      announcement_{own_.publicKey, portOf(channels_->controlAddress())} {}

std::optional<config::KeyFile> NodeDoor::serve(net::Duration atMost) {
    constexpr net::Duration kBetweenLooks = std::chrono::seconds(1);
    channels_->wait(atMost);
    answer();
    const net::Moment now = net::monotonicNow();
    if (now >= lookedAt_ + kBetweenLooks) {
        lookedAt_ = now;
        announcement_.followAddresses();
        node_.renewCode(now);
    }
    return node_.key();
}

void NodeDoor::answer() {
    while (const auto from = channels_->receiveControl()) {
        const auto word = wordIn(from->bytes);
        if (!word) continue;
        const auto reply = node_.hear(from->peer, *word, net::monotonicNow());
        if (!reply) continue;
        if (reply->kind == Word::Kind::Refused)
            logWarning("a key was offered, and refused: {}", reply->content);
        channels_->sendControl(from->peer, packetOf(*reply));
    }
}

NodeSign NodeDoor::sign() const {
    return {announcement_.letter(), shownCode(node_.code()), ownAddresses()};
}

}  // namespace aquarama::enrol
