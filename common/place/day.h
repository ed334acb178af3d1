// SPDX-License-Identifier: Apache-2.0
// The day of a scene: its clock, its eight phases and how bright they are. Pure functions, the same
// on every machine: no libm. The time of day is a share of the day, 0 to 1 (1 excluded): 0 is
// midnight, 0.5 noon.
//
// | phase       | from   | to     | at 1200 s a day, s after dawn begins |
// |-------------|--------|--------|--------------------------------------|
// | dawn        | 0.1625 | 0.2625 |    0 -  120                          |
// | morning     | 0.2625 | 0.4375 |  120 -  330                          |
// | noon        | 0.4375 | 0.5625 |  330 -  480                          |
// | afternoon   | 0.5625 | 0.7375 |  480 -  690                          |
// | sunset      | 0.7375 | 0.8125 |  690 -  780                          |
// | dusk        | 0.8125 | 0.8875 |  780 -  870                          |
// | night       | 0.8875 | 0.0875 |  870 - 1110                          |
// | first light | 0.0875 | 0.1625 | 1110 - 1200                          |
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/units.h"
#include "common/config/scene.h"

namespace aquarama::place {

// In the order of the day.
enum class DayPhase : std::uint8_t {
    Dawn,
    Morning,
    Noon,
    Afternoon,
    Sunset,
    Dusk,
    Night,
    FirstLight,
};
inline constexpr std::size_t kDayPhases = 8;
// Its name for people, such as "first light".
[[nodiscard]] const char* nameOf(DayPhase phase);

// The time of day at which a phase begins. It ends where the next one begins.
[[nodiscard]] double beginOf(DayPhase phase);
// The phase at a time of day.
[[nodiscard]] DayPhase phaseOf(double timeOfDay);
// How much of the phase of a time of day has passed, 0 to 1.
[[nodiscard]] double passedOf(double timeOfDay);
// The time of day at which a share of a phase has passed. A share below 0 is before the phase, one
// above 1 after it, by less than a day.
[[nodiscard]] double timeIn(DayPhase phase, double share);
// Whether it is day: from the end of dawn until sunset begins.
[[nodiscard]] bool isDaytime(double timeOfDay);

// A value of each phase, in the order of the day.
using ByPhase = std::array<float, kDayPhases>;
// The value at a time of day, without a jump: in the first half of a phase it goes from that of the
// phase before to its own by a smoothstep. Where both are equal it is exactly theirs.
[[nodiscard]] float valueAt(const ByPhase& values, double timeOfDay);

// Light of the sky, before it enters the water: 1 by day, Day::night at night. It rises by a
// smoothstep over first light and dawn, and falls by one over sunset and dusk.
[[nodiscard]] float daylightAt(const config::Day& day, double timeOfDay);

// The clock of a scene: what time of day it was at a tick, and how long a day lasts from then on.
struct DayClock {
    Tick since;
    double timeOfDay = 0.5;
    double lengthSeconds = 0;  // 0: it stands still
    friend bool operator==(const DayClock&, const DayClock&) = default;
};
// The clock with which a scene begins. One that follows a hall stands still until it is set.
[[nodiscard]] DayClock clockOf(const config::Day& day);
// The time of day at a tick, which is not before `since`.
[[nodiscard]] double timeOfDayAt(const DayClock& clock, Tick tick);

}  // namespace aquarama::place
