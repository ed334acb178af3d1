// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/hours.h"

#include <algorithm>

#include "common/base/random_streams.h"

namespace aquarama::behaviour {

namespace {

// By how much the largest retires later than the smallest, and rises earlier; and by how much any
// fish may do either earlier or later: shares of the twilight.
constexpr double kBySize = 0.3;
constexpr double kByItself = 0.1;

// The share of a day from one time of day to the next time that it is another.
double until(double time, double other) {
    return other < time ? other - time + 1 : other - time;
}

}  // namespace

float sizeRankOf(const fish::SpeciesParameters& parameters, float lengthMetres) {
    const float range = parameters.size.mostMetres - parameters.size.leastMetres;
    if (range <= 0) return 0.5F;
    return std::clamp((lengthMetres - parameters.size.leastMetres) / range, 0.0F, 1.0F);
}

bool restsAt(const fish::SpeciesParameters& parameters,
             std::uint32_t seed,
             std::uint32_t fish,
             float lengthMetres,
             double timeOfDay) {
    const config::ActiveHours& hours = parameters.habits.hours;
    if (hours.active == config::Activity::Always) return false;
    const auto rank = static_cast<double>(sizeRankOf(parameters, lengthMetres));
    const std::uint32_t own = hashOf(seed, Stream::HoursOfRest, fish);
    const double longer =
        kBySize * (rank - 0.5) + kByItself * static_cast<double>(signedUnitOf(own));
    const bool isOfTheDay = hours.active == config::Activity::Day;
    const place::DayPhase evening = isOfTheDay ? place::DayPhase::Dusk : place::DayPhase::Dawn;
    const place::DayPhase morning = isOfTheDay ? place::DayPhase::Dawn : place::DayPhase::Dusk;
    const double retires = place::timeIn(evening, hours.retires + longer);
    const double rises = place::timeIn(morning, hours.rises - longer);
    return until(retires, timeOfDay) < until(retires, rises);
}

}  // namespace aquarama::behaviour
