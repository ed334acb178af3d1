// SPDX-License-Identifier: Apache-2.0
// The clock of the hall, mapped onto the day of a scene that follows it: dusk comes at closing
// time.
#pragma once

#include <filesystem>
#include <optional>

#include "common/config/hours.h"
#include "master/world/events.h"

namespace aquarama::conductor {

// Seconds from one correction of a scene's clock to the next.
inline constexpr int kClockCorrectionSeconds = 600;

// Two moments of the hall's day, minutes from midnight, and the times of the scene's day at which
// they come. Between them time goes evenly.
struct HallDay {
    double firstMinute = 0, secondMinute = 0;  // the second may be of the next day
    double firstTime = 0, secondTime = 0;
};
// With the opening times of a day the morning begins as the hall opens, and dusk ends as it closes.
// Without, dawn begins at 6:00 and dusk at 18:00, as the sun usually rises and sets.
[[nodiscard]] HallDay hallDayOf(const std::optional<config::OpenTimes>& open);
// The time of the scene's day, 0 to 1 (1 excluded), at a minute of the hall's, 0 to 1440.
[[nodiscard]] double timeOfDayAt(const HallDay& day, double minute);

// What the hall's clock says at one moment, and a correction later.
class HallClock {
  public:
    // Minutes of the hall's day, 0 to 1440.
    HallClock(const HallDay& day, double minute);

    // Sets a scene's clock to the hall's.
    [[nodiscard]] world::SetClock setting() const;
    // Lets a scene's clock, which says `timeOfDay`, come to the hall's within the time to the next
    // correction, so that the light makes no jump. One that is ahead stands still; one that is more
    // than a quarter of a day off is set.
    [[nodiscard]] world::SetClock correction(double timeOfDay) const;

  private:
    double now_, later_;  // times of the scene's day
};

// The hall's clock at a moment of Unix time: by the hours in the file, where there are any that can
// be read, else by the local time of this machine.
[[nodiscard]] HallClock readHallClock(const std::filesystem::path& hoursFile,
                                      long long unixSeconds);
// The present moment.
[[nodiscard]] long long unixNow();

}  // namespace aquarama::conductor
