// SPDX-License-Identifier: Apache-2.0
// Hands and questions of visitors, passed on to the tick thread: food, steering, and what goes on
// in the mind of a fish.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>

#include "common/net/channels.h"
#include "common/wire/messages.h"
#include "master/conductor/roster.h"
#include "master/conductor/sender.h"
#include "master/conductor/simulation_thread.h"
#include "master/conductor/steering.h"
#include "master/conductor/trackers.h"

namespace aquarama::conductor {

// Of the conductor's thread.
class VisitorInputs {
  public:
    // `wake` is called by the tick thread when an answer is there. Both outlive this.
    VisitorInputs(const Sender& sender, std::function<void()> wake);

    // The world that they reach, of so many fish; null: none, and nothing is passed on.
    void enter(SimulationThread* world, std::uint32_t fish);
    [[nodiscard]] std::uint32_t fish() const { return fish_; }

    // Each returns false where it is refused: out of reach, or too much waits already.
    // Food from a window; `seat` is its node's.
    [[nodiscard]] bool feed(NodeSeat& seat,
                            const v1::Input& input,
                            const wire::Eye& eye,
                            net::Moment now);
    // Food from somebody who is no node.
    [[nodiscard]] bool feed(const std::string& user,
                            const v1::Input& input,
                            const wire::Eye& eye,
                            net::Moment now);
    [[nodiscard]] bool steer(const net::PeerId& peer, const v1::Input& input, net::Moment now);
    // Hands before the wall, as one tracker sees them.
    [[nodiscard]] bool touch(const net::PeerId& peer, const v1::Input& input, net::Moment now);
    // A question about a mind; answer() sends what comes back.
    [[nodiscard]] bool ask(const net::PeerId& peer, std::uint32_t fish);
    void answer();
    // Who steers; nothing: nobody does.
    [[nodiscard]] std::optional<net::PeerId> pilot(net::Moment now) const {
        return arbitration_.pilot(now);
    }

  private:
    bool feed(net::Moment& lastFed, const v1::Input& input, const wire::Eye& eye, net::Moment now);

    const Sender& sender_;
    std::function<void()> wake_;
    SimulationThread* world_ = nullptr;
    std::uint32_t fish_ = 0;
    InputArbitration arbitration_;
    Trackers trackers_;
    std::map<std::string, net::Moment> lastFed_;  // by user that is no node
    // Written by the tick thread. A full queue drops the answer, and the client asks again.
    net::BoundedQueue<std::pair<net::PeerId, wire::Packet>> explanations_{256};
};

}  // namespace aquarama::conductor
