// SPDX-License-Identifier: Apache-2.0
// All that the conductor knows of the world.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/base/units.h"
#include "common/motion/motion_state.h"
#include "common/net/clock.h"
#include "common/wire/state_codec.h"
#include "master/world/events.h"

namespace aquarama::conductor {

// The world at one tick, as it is sent: one record a fish, in the order of the school.
struct Snapshot {
    Tick tick;
    net::Moment due{};  // live: when the world was like this; set by the tick thread
    std::uint64_t hash = 0;
    wire::Eye eye;
    float daylight = 1.0F;  // of the sky, 0 to 1
    std::vector<motion::FishRecord> fish;
    wire::FoodCloud food;
};

// Called from the tick thread only.
class Simulation {
  public:
    virtual ~Simulation() = default;
    virtual void advance() = 0;  // by one tick
    // Applies an input between two ticks: the only way in which the world is changed from outside.
    virtual void apply(const world::WorldInput& input) = 0;
    [[nodiscard]] virtual Tick tick() const = 0;
    // Hash of all that the next tick depends on.
    [[nodiscard]] virtual std::uint64_t hash() const = 0;
    [[nodiscard]] virtual Snapshot snapshot() const = 0;
    // What goes on in the mind of a fish, as lines of printable ASCII within the bounds of
    // a reply (kMostExplanationLines of common/wire/messages.h).
    [[nodiscard]] virtual std::vector<std::string> explain(std::uint32_t fish) const = 0;
};

}  // namespace aquarama::conductor
