// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/hall_clock.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "common/base/log.h"
#include "common/config/text_file.h"
#include "common/place/day.h"

namespace aquarama::conductor {

namespace {

constexpr double kMinutesOfDay = 1440;
constexpr double kSecondsOfMinute = 60;
constexpr double kSunrise = 6 * 60, kSunset = 18 * 60;
// A clock that is farther off is set.
constexpr double kFarOff = 0.25;

// From one point of a circle forward to another.
double forward(double from, double to, double round) {
    const double way = std::fmod(to - from, round);
    return way < 0 ? way + round : way;
}

// The length of a day whose clock goes so far in the time between two corrections.
double lengthFor(double way) {
    return way > 0 ? kClockCorrectionSeconds / way : 0;
}

// Nothing where there is no such file or it cannot be read: the show goes on.
std::optional<config::Hours> hoursIn(const std::filesystem::path& file) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none)) return std::nullopt;
    try {
        return config::parseHours(config::readTextFile(file.string()), file.string());
    } catch (const Error& error) {
        logWarning("the day does not follow these hours: {}", error.what());
        return std::nullopt;
    }
}

double localMinute(long long unixSeconds) {
    const auto moment = static_cast<std::time_t>(unixSeconds);
    std::tm local{};
    localtime_r(&moment, &local);
    return 60.0 * local.tm_hour + local.tm_min + local.tm_sec / kSecondsOfMinute;
}

}  // namespace

HallDay hallDayOf(const std::optional<config::OpenTimes>& open) {
    using place::DayPhase;
    if (!open) return {kSunrise, kSunset, beginOf(DayPhase::Dawn), beginOf(DayPhase::Dusk)};
    return {static_cast<double>(open->from),
            static_cast<double>(open->to),
            beginOf(DayPhase::Morning),
            beginOf(DayPhase::Night)};
}

double timeOfDayAt(const HallDay& day, double minute) {
    // A wall that is open day and night has its midnight where one day meets the next.
    const double span = std::min(day.secondMinute - day.firstMinute, kMinutesOfDay - 1);
    const double since = forward(day.firstMinute, minute, kMinutesOfDay);
    const double rise = day.secondTime - day.firstTime;
    const double time =
        since < span ? day.firstTime + rise * (since / span)
                     : day.secondTime + (1 - rise) * ((since - span) / (kMinutesOfDay - span));
    return forward(0, time, 1);
}

HallClock::HallClock(const HallDay& day, double minute)
    : now_{timeOfDayAt(day, minute)},
      later_{timeOfDayAt(
          day, std::fmod(minute + kClockCorrectionSeconds / kSecondsOfMinute, kMinutesOfDay))} {}

world::SetClock HallClock::setting() const {
    return {.timeOfDay = now_, .lengthSeconds = lengthFor(forward(now_, later_, 1))};
}

world::SetClock HallClock::correction(double timeOfDay) const {
    const double way = forward(timeOfDay, later_, 1);
    const double behind = way > 0.5 ? way - 1 : way;
    if (std::abs(behind) > kFarOff) return setting();
    return {.timeOfDay = forward(0, timeOfDay, 1), .lengthSeconds = lengthFor(behind)};
}

HallClock readHallClock(const std::filesystem::path& hoursFile, long long unixSeconds) {
    const std::optional<config::Hours> hours = hoursIn(hoursFile);
    if (!hours) return {hallDayOf({}), localMinute(unixSeconds)};
    const config::CivilTime now = config::civilTime(hours->zone, unixSeconds);
    const double minute = now.minute + static_cast<double>(unixSeconds % 60) / kSecondsOfMinute;
    return {hallDayOf(config::openTimesOn(*hours, now)), minute};
}

long long unixNow() {
    return std::chrono::duration_cast<std::chrono::seconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

}  // namespace aquarama::conductor
