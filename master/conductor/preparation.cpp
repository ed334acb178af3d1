// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/preparation.h"

#include <chrono>

#include "common/wire/messages.h"

namespace aquarama::conductor {

Preparation::Preparation(net::MasterChannels& channels)
    : channels_{channels}, thread_{[this] { run(); }} {}

Preparation::~Preparation() {
    isOver_ = true;
    channels_.wake();
    thread_.join();
}

// The prefix tells a reader who speaks: it stands in logs of nodes, and in errors of commands.
std::string Preparation::tell(const std::string& what) {
    const std::lock_guard lock(mutex_);
    sentence_ = "the master prepares: " + what;
    return sentence_;
}

void Preparation::say(const std::string& sentence) {
    const std::lock_guard lock(mutex_);
    sentence_ = sentence;
}

// What strangers say to the state channel is thrown away here as well.
void Preparation::run() {
    constexpr net::Duration kLongestWait = std::chrono::milliseconds(100);
    while (!isOver_) {
        channels_.wait(kLongestWait);
        static_cast<void>(channels_.discardNoise());
        while (!isOver_) {
            const auto from = channels_.receiveControl();
            if (!from) break;
            answer(*from);
        }
    }
}

// Whoever is dismissed asks again by itself, also a node of the run before. Hands at the helm and
// farewells expect no answer.
void Preparation::answer(const net::FromPeer& from) {
    const auto message = wire::decode(from.bytes);
    if (!message || from.peer.empty() || message->has_input() || message->has_farewell()) return;
    v1::Envelope reply;
    {
        const std::lock_guard lock(mutex_);
        reply.mutable_dismissed()->set_reason(sentence_);
    }
    channels_.sendControl(from.peer, wire::encode(0, std::move(reply)));
}

}  // namespace aquarama::conductor
