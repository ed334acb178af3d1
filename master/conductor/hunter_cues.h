// SPDX-License-Identifier: Apache-2.0
// Which hunters of the scene can be called before the wall, and calls that the world has not heard.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "master/conductor/simulation.h"

namespace aquarama::conductor {

// Of the conductor's thread.
class HunterCues {
  public:
    // The hunters of the world that is shown from now on; calls for others are forgotten.
    void enter(std::vector<Hunter> hunters);
    // Calls one of this species. Why it does not come; empty: it will.
    [[nodiscard]] std::string call(const std::string& species);
    // Those that were called since, for the world.
    [[nodiscard]] std::vector<world::ReleaseHunter> take() { return std::exchange(called_, {}); }

  private:
    std::vector<Hunter> hunters_;
    std::vector<world::ReleaseHunter> called_;
};

}  // namespace aquarama::conductor
