// SPDX-License-Identifier: Apache-2.0
// Steering from a terminal, which reports keys that are pressed but not those that are released:
// each key moves an axis by a notch, and there it stays.
#pragma once

#include <string>
#include <string_view>

#include "common/units/units.h"

namespace aquarama::conductor {

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

inline constexpr std::string_view kTerminalSteeringHelp =
    "w s ahead, back   a d aside   left right turn   up down rise, sink   r f nose up, down   "
    "space lets go   q leaves";

}  // namespace aquarama::conductor
