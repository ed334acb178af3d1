// SPDX-License-Identifier: Apache-2.0
// Whose hand steers, where several pilots are: the latest that takes hold. It has the helm until it
// lets go, falls silent, or another takes hold.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "common/net/channels.h"
#include "common/net/clock.h"
#include "common/units/steering.h"

namespace aquarama {

class Helm {
  public:
    // What a pilot's window says. True: the submarine is to hear it.
    [[nodiscard]] bool heeds(const PeerId& pilot, const Steering& steering, Instant now);
    // Who has it; empty: nobody.
    [[nodiscard]] std::optional<PeerId> pilot(Instant now) const;

  private:
    struct Hand {
        bool holds = false;
        Instant heard{};
    };
    [[nodiscard]] static bool holds(const Hand& hand, Instant now);
    void forgetTheSilent(Instant now);

    std::map<PeerId, Hand> hands_;
    PeerId holder_;
};

}  // namespace aquarama
