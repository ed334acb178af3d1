// SPDX-License-Identifier: Apache-2.0
// From what hands hold to what the submarine is told, and when it is told.
#pragma once

#include <chrono>
#include <optional>

#include "common/units/steering.h"
#include "render_node/context/hands.h"

namespace aquarama::show {

// W S, arrows up and down: ahead and back. A D: aside. Arrows left and right: turn. Page up and
// down: rise and sink. Home, End: nose up, down. The mouse with its right button turns and tilts by
// how far it is dragged. Gamepad: left stick ahead and aside, right stick turns and tilts, triggers
// sink and rise. What several say adds up.
[[nodiscard]] Steering steeringOf(const context::Hands& hands);

// When a steering goes out: at once when it changes, thirty times a second at most, and now and
// then while something is held, so that what is lost is made good before the submarine takes the
// hand for gone.
class SteeringPace {
  public:
    [[nodiscard]] std::optional<Steering> due(const Steering& wanted, std::chrono::nanoseconds now);

  private:
    Steering said_;
    std::optional<std::chrono::nanoseconds> saidAt_;
};

}  // namespace aquarama::show
