// SPDX-License-Identifier: Apache-2.0
// A theatre's desk that speaks OSC: its cues become orders, and it is told what the wall shows.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/config/rig.h"
#include "console/cues/cue.h"
#include "console/cues/shown.h"
#include "console/cues/udp_port.h"

namespace aquarama::console {

// Gives an order, which gets a number where it has none; the reply names it. Said again with that
// number, it tells what has become of the order. `who`: as the list of events names the sender.
using GiveOrder = std::function<v1::OrderReply(const std::string& who, const v1::Order& order)>;

// Since the start.
struct CueCounts {
    std::uint64_t given = 0;      // orders
    std::uint64_t refused = 0;    // messages that are no cue, and orders that were refused
    std::uint64_t strangers = 0;  // packets of other senders, dropped
};

// A fader that moves is one order at a time: of what one address was sent between two ticks, the
// last counts. All work of a tick is bounded, whatever comes. Of the server's thread.
class OscDesk {
  public:
    // Listens. Throws Error where it cannot.
    OscDesk(config::OscCues how, GiveOrder give);

    // Ten times a second, with what the wall shows (shownBy()).
    void tick(std::vector<ShownValue> shown);
    [[nodiscard]] const CueCounts& counts() const { return counts_; }

  private:
    // A cue whose end is not known yet.
    struct GivenCue {
        config::UdpAddress from;
        std::string address;  // of OSC
        v1::Order order;
    };

    void follow();
    void hear();
    void take(const config::UdpAddress& from, const osc::OscMessage& message);
    void give();
    [[nodiscard]] v1::OrderReply said(const GivenCue& cue);
    // Said to the sender, and to the log once a second at most.
    void refuse(const config::UdpAddress& to, const std::string& address, const std::string& why);
    void tell(std::vector<ShownValue> shown);
    void sendToAll(const ShownValue& value);

    config::OscCues how_;
    GiveOrder give_;
    UdpPort port_;
    std::map<std::string, GivenCue> heard_;  // in this tick, by the address of OSC
    std::vector<GivenCue> given_;            // whose end is waited for
    std::vector<ShownValue> told_;           // what receivers know
    CueCounts counts_;
    int ticks_ = 0;
    int repliesLeft_ = 0;  // of this tick
    int ticksToWarn_ = 0;
};

}  // namespace aquarama::console
