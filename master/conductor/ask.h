// SPDX-License-Identifier: Apache-2.0
// Questions that anybody may ask the running master.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "common/net/channels.h"
#include "common/net/clock.h"
#include "common/units/log.h"
#include "common/wire/envelope.h"

namespace aquarama::conductor {

class RequestClient {
  public:
    explicit RequestClient(const std::string& controlAddress)
        : address_(controlAddress), channels_(net::connectNode(controlAddress)) {}

    // The newest answer; the question is repeated until there is one, since the connection may not
    // stand yet. Throws Error where nobody answers.
    template <class Reply>
    Reply ask(const wire::Message& question) {
        constexpr net::Instant kPatience = std::chrono::seconds(2);
        constexpr net::Instant kRepeat = std::chrono::milliseconds(50);
        const net::Instant giveUp = net::monotonicNow() + kPatience;
        while (net::monotonicNow() < giveUp) {
            channels_->sendControl(wire::encode({0, question}));
            channels_->wait(kRepeat);
            if (auto reply = newest<Reply>()) return *std::move(reply);
        }
        throw Error("no master answers at " + address_ +
                    "; start one, or name its control address with --master");
    }

    // What is not answered.
    void tell(const wire::Message& message) { channels_->sendControl(wire::encode({0, message})); }

  private:
    template <class Reply>
    std::optional<Reply> newest() {
        std::optional<Reply> newest;
        while (const auto bytes = channels_->receiveControl()) {
            auto envelope = wire::decode(*bytes);
            if (!envelope) continue;
            if (auto* reply = std::get_if<Reply>(&envelope->message)) newest = std::move(*reply);
        }
        return newest;
    }

    std::string address_;
    std::unique_ptr<net::NodeChannels> channels_;
};

}  // namespace aquarama::conductor
