// SPDX-License-Identifier: Apache-2.0
// All that the conductor knows of the world.
#pragma once

#include <cstdint>
#include <vector>

#include "common/motion/motion_state.h"
#include "common/units/units.h"
#include "common/wire/envelope.h"
#include "common/wire/messages.h"
#include "master/world/events.h"

namespace aquarama::conductor {

// Called from the tick thread only.
class Simulation {
  public:
    virtual ~Simulation() = default;
    virtual void advance() = 0;  // by one tick
    // Between two ticks. Whatever reaches the world from outside comes this way.
    virtual void apply(const world::WorldInput& input) = 0;
    [[nodiscard]] virtual Tick tick() const = 0;
    virtual void records(std::vector<motion::FishRecord>& fish) const = 0;
    virtual void food(wire::FoodCloud& cloud) const = 0;
    [[nodiscard]] virtual wire::Eye eye() const = 0;
    [[nodiscard]] virtual float daylight() const = 0;  // of the sky, 0 to 1
    [[nodiscard]] virtual std::uint64_t hash() const = 0;
    // What goes on in the mind of a fish; no lines for one that is not of the school.
    [[nodiscard]] virtual wire::Explanation explain(std::uint32_t fish) const = 0;
};

}  // namespace aquarama::conductor
