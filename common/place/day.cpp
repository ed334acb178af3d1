// SPDX-License-Identifier: Apache-2.0
#include "common/place/day.h"

#include <algorithm>
#include <cassert>

namespace aquarama::place {

namespace {

// The beginnings of the phases in the order of the day; those after midnight are one day later.
// The last one is the beginning of the next day's dawn.
constexpr std::array<double, kDayPhases + 1> kBegins{
    0.1625, 0.2625, 0.4375, 0.5625, 0.7375, 0.8125, 0.8875, 1.0875, 1.1625};

// The time of day counted from dawn on: below that of dawn it is that of the next day.
double sinceDawn(double timeOfDay) {
    assert(timeOfDay >= 0);
    assert(timeOfDay <= 1);
    return timeOfDay < kBegins.front() ? timeOfDay + 1 : timeOfDay;
}

std::size_t indexOf(double timeFromDawn) {
    std::size_t phase = kDayPhases - 1;
    while (phase > 0 && timeFromDawn < kBegins[phase]) --phase;
    return phase;
}

double smoothstep(double from, double to, double at) {
    const double share = std::clamp((at - from) / (to - from), 0.0, 1.0);
    return share * share * (3 - 2 * share);
}

}  // namespace

const char* nameOf(DayPhase phase) {
    constexpr std::array<const char*, kDayPhases> kNames{
        "dawn", "morning", "noon", "afternoon", "sunset", "dusk", "night", "first light"};
    return kNames[static_cast<std::size_t>(phase)];
}

double beginOf(DayPhase phase) {
    const double begin = kBegins[static_cast<std::size_t>(phase)];
    return begin >= 1 ? begin - 1 : begin;
}

DayPhase phaseOf(double timeOfDay) {
    return static_cast<DayPhase>(indexOf(sinceDawn(timeOfDay)));
}

double passedOf(double timeOfDay) {
    const double time = sinceDawn(timeOfDay);
    const std::size_t phase = indexOf(time);
    return (time - kBegins[phase]) / (kBegins[phase + 1] - kBegins[phase]);
}

double timeIn(DayPhase phase, double share) {
    const auto index = static_cast<std::size_t>(phase);
    const double time = beginOf(phase) + share * (kBegins[index + 1] - kBegins[index]);
    return time < 0 ? time + 1 : time >= 1 ? time - 1 : time;
}

bool isDaytime(double timeOfDay) {
    const DayPhase phase = phaseOf(timeOfDay);
    return phase >= DayPhase::Morning && phase <= DayPhase::Afternoon;
}

float valueAt(const ByPhase& values, double timeOfDay) {
    const auto phase = static_cast<std::size_t>(phaseOf(timeOfDay));
    const float own = values[phase];
    const float before = values[(phase + kDayPhases - 1) % kDayPhases];
    const auto share = static_cast<float>(smoothstep(0, 0.5, passedOf(timeOfDay)));
    return share == 1 ? own : before + (own - before) * share;
}

float daylightAt(const config::Day& day, double timeOfDay) {
    const double time = sinceDawn(timeOfDay);
    const auto begin = [](DayPhase phase) { return kBegins[static_cast<std::size_t>(phase)]; };
    const double firstLight = begin(DayPhase::FirstLight);
    const double rises = smoothstep(firstLight,
                                    begin(DayPhase::Morning) + 1,
                                    time < begin(DayPhase::Morning) ? time + 1 : time);
    const double falls = smoothstep(begin(DayPhase::Sunset), begin(DayPhase::Night), time);
    const bool isBeforeMorning = time < begin(DayPhase::Morning) || time >= firstLight;
    const double risen = isBeforeMorning ? rises : 1 - falls;
    return static_cast<float>(day.night + (1 - day.night) * risen);
}

DayClock clockOf(const config::Day& day) {
    return {.since = {},
            .timeOfDay = day.startsAt >= 1 ? day.startsAt - 1 : day.startsAt,
            .lengthSeconds = day.followsHall ? 0 : day.lengthSeconds};
}

double timeOfDayAt(const DayClock& clock, Tick tick) {
    assert(tick >= clock.since);
    if (clock.lengthSeconds <= 0) return clock.timeOfDay;
    const double time =
        clock.timeOfDay + static_cast<double>(tick.value - clock.since.value) /
                              (clock.lengthSeconds * static_cast<double>(kTicksPerSecond));
    return time - static_cast<double>(static_cast<std::int64_t>(time));
}

}  // namespace aquarama::place
