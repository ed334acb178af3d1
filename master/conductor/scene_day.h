// SPDX-License-Identifier: Apache-2.0
// What time of day a scene has: that of a clock of its own, that of the hall, or the one that is
// wanted of the wall.
#pragma once

#include <filesystem>
#include <optional>

#include "common/net/clock.h"
#include "common/wire/wanted_show.h"
#include "master/conductor/simulation.h"
#include "master/conductor/simulation_thread.h"

namespace aquarama::conductor {

// So long a scene takes to the time of day that is wanted.
inline constexpr double kDayGlideSeconds = 40;

// The middle of the phase that is wanted, 0 to 1; nothing: the clock's.
[[nodiscard]] std::optional<double> timeWantedBy(v1::WantedShow::Day day);

// Of the conductor's thread.
class SceneDay {
  public:
    // `hoursAt`: hours of the hall.
    explicit SceneDay(std::filesystem::path hoursAt) : hoursAt_{std::move(hoursAt)} {}

    // A world that is shown next, before its first tick: it is at once at the day that is wanted.
    void begin(Simulation& world, v1::WantedShow::Day wanted, net::Moment now);
    // Has the scene glide to what is wanted; corrects a clock that follows the hall every few
    // minutes, where nothing else is wanted.
    void turn(SimulationThread& world, v1::WantedShow::Day wanted, net::Moment now);

  private:
    std::filesystem::path hoursAt_;
    v1::WantedShow::Day day_ = v1::WantedShow::CLOCK;  // of the world
    std::optional<net::Moment> clockSet_;              // nothing: it does not follow the hall
};

}  // namespace aquarama::conductor
