// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/scene_day.h"

#include <chrono>

#include "common/place/day.h"
#include "master/conductor/hall_clock.h"

namespace aquarama::conductor {

using v1::WantedShow;

std::optional<double> timeWantedBy(WantedShow::Day day) {
    static_assert(WantedShow::FIRST_LIGHT - WantedShow::DAWN == int{place::kDayPhases} - 1);
    if (day < WantedShow::DAWN) return std::nullopt;
    return place::timeIn(static_cast<place::DayPhase>(day - WantedShow::DAWN), 0.5);
}

void SceneDay::begin(Simulation& world, WantedShow::Day wanted, net::Moment now) {
    clockSet_.reset();
    if (world.followsHall()) {
        world.apply(readHallClock(hoursAt_, unixNow()).setting());
        clockSet_ = now;
    }
    // A world that goes on may still have another day than is wanted now.
    const auto time = timeWantedBy(wanted);
    if (time || world.tick() > Tick{}) world.apply(world::SetDay{.timeOfDay = time});
    day_ = wanted;
}

void SceneDay::turn(SimulationThread& world, WantedShow::Day wanted, net::Moment now) {
    constexpr auto kBetween = std::chrono::seconds(kClockCorrectionSeconds);
    const bool isAnother = wanted != day_;
    const bool isDue =
        clockSet_ && wanted == WantedShow::CLOCK && (isAnother || now - *clockSet_ >= kBetween);
    if (!isAnother && !isDue) return;
    const auto change = [=, hall = readHallClock(hoursAt_, unixNow())](Simulation& simulation) {
        // Behind a day that was wanted the clock was not corrected, and nobody sees it.
        if (isDue)
            simulation.apply(isAnother ? hall.setting()
                                       : hall.correction(double{simulation.snapshot().timeOfDay}));
        if (isAnother) simulation.apply(world::SetDay{timeWantedBy(wanted), kDayGlideSeconds});
    };
    if (!world.betweenTicks(change)) return;
    if (isDue) clockSet_ = now;
    day_ = wanted;
}

}  // namespace aquarama::conductor
