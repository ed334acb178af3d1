// SPDX-License-Identifier: Apache-2.0
// Who steers the submarine, and steering from a terminal.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "common/base/units.h"
#include "common/net/channels.h"
#include "common/net/clock.h"

namespace aquarama::conductor {

// What a pilot does.
struct PilotHand {
    Steering steering;
    bool yields = false;  // to whoever does not
};

// Arbitration between pilots: the latest who begins to steer has control until he stops, sends
// nothing for half a second, or another begins. Whoever yields has none while another steers. Of
// the conductor's thread.
class InputArbitration {
  public:
    // The input of a pilot. True: it is applied to the submarine.
    [[nodiscard]] bool accepts(const net::PeerId& pilot, const PilotHand& hand, net::Moment now);
    // Who has control; empty: nobody.
    [[nodiscard]] std::optional<net::PeerId> pilot(net::Moment now) const;

  private:
    struct HeldInput {
        bool holds = false;
        bool yields = false;
        net::Moment heard{};
    };
    [[nodiscard]] static bool holds(const HeldInput& input, net::Moment now);
    void forgetTheSilent(net::Moment now);
    // Whether somebody who begins may take control now.
    [[nodiscard]] bool mayTake(const HeldInput& input, bool begins) const;

    std::map<net::PeerId, HeldInput> inputs_;
    net::PeerId holder_;
};

// A terminal reports keys that are pressed but not those that are released: each key moves an axis
// by a notch, and there it stays.
class TerminalSteering {
  public:
    // What a terminal sent: letters and escape sequences of keys; the rest means nothing.
    void press(std::string_view bytes);
    [[nodiscard]] const Steering& steering() const { return steering_; }
    [[nodiscard]] bool ended() const { return ended_; }  // q, Esc or Ctrl-C was pressed
    // How the axes stand that are not at rest, in words.
    [[nodiscard]] std::string text() const;

  private:
    Steering steering_;
    bool ended_ = false;
};

// One line that names the keys.
inline constexpr std::string_view kTerminalSteeringHelp =
    "w s ahead, back   a d aside   left right turn   up down rise, sink   r f nose up, down   "
    "space lets go   q leaves";

}  // namespace aquarama::conductor
