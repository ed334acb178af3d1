// SPDX-License-Identifier: Apache-2.0
// What a visitor sees over hours: the figures of every second, by day and by night. It only reads
// the world, after a tick, on the thread of the world.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/config/rig.h"
#include "common/config/scene.h"
#include "master/study/occupation.h"
#include "master/study/school_path.h"
#include "master/study/wall_events.h"
#include "master/study/wall_view.h"
#include "master/world/world.h"

namespace aquarama::study {

// Day is from the end of dawn to sunset; all else is night.
enum class DayPart : std::uint8_t { Day, Night };
inline constexpr std::size_t kDayParts = 2;
inline constexpr std::array<DayPart, kDayParts> kAllDayParts{DayPart::Day, DayPart::Night};

// The part of a scene's day at a tick. Day is the half of its length about noon; a day of length 0
// stands still.
[[nodiscard]] DayPart dayPartOf(const config::Day& day, Tick tick);

// A third of the wall is full with so many large fish.
inline constexpr std::uint32_t kFishOfAFullThird = 5;

// The figures of one second.
struct WallSecond {
    DayPart part = DayPart::Day;
    WallGlance glance;
    // Parts of the school (partsOf()), and its centre; nothing while none of it is there.
    std::uint32_t parts = 0;
    std::optional<glm::dvec3> centre = {};
};

// Median and 5 % quantile of a figure over some seconds; 0 without any.
struct Typical {
    double median = 0, low = 0;
};

// The figures of all seconds of a part of the day. Shares are 0 to 1.
struct WallFigures {
    std::size_t seconds = 0;
    Typical cellShare, inView, largestGroup, species, parts;
    // Large fish by third.
    std::array<Typical, kThirds> large{};
    // Share of the time in which a third is full, and in which all are.
    std::array<double, kThirds> full{};
    double allFull = 0;
    // Longest time in which a third has no large fish.
    std::array<std::uint64_t, kThirds> gapSeconds{};
    // Mean number of fish in view.
    double meanInView = 0;
    // Events in view by kind, a minute, and of all kinds.
    std::array<double, kWallEvents> eventsAMinute{};
    double allEventsAMinute = 0;
};
// Of those seconds and events that are in this part of the day.
[[nodiscard]] WallFigures wallFiguresOf(std::span<const WallSecond> seconds,
                                        std::span<const NotedEvent> events,
                                        const config::Day& day,
                                        DayPart part);

// The line that sums up a part of the day: "wall: cells 16 %, thirds ...".
[[nodiscard]] std::string wallLine(const WallFigures& figures);

// How the fish of a species keep together and what they do, in one part of the day.
struct SpeciesFigures {
    // Mean distance to the nearest neighbour, in body lengths, and polarisation (SchoolFigures), of
    // a species of two fish and more.
    Typical nearestNeighbour, polarisation;
    // Share of the time of its fish, by occupation; and of that in which they swim, at
    // kSwimmingLengths a second and more.
    std::array<double, kOccupations> occupationShare{};
    double swims = 0;
    // Share of the time within kAtHomeMetres of a site of the kind that the species lives at;
    // nothing for species without.
    std::optional<double> atHome = {};
};
inline constexpr float kSwimmingLengths = 0.1F;
inline constexpr float kAtHomeMetres = 0.3F;

// Watches one world through one wall.
class WallStudy {
  public:
    // Keeps a reference to the rig. Throws Error where the file of a measured screen cannot be
    // used.
    WallStudy(const config::Rig& rig, const world::World& world);
    ~WallStudy() = default;
    WallStudy(const WallStudy&) = delete;
    WallStudy& operator=(const WallStudy&) = delete;

    // Call it after every tick.
    void note(const world::World& world);
    // The figures so far.
    [[nodiscard]] std::span<const WallSecond> seconds() const { return seconds_; }
    [[nodiscard]] std::span<const NotedEvent> events() const { return watch_.all(); }
    [[nodiscard]] WallFigures figures(DayPart part) const;
    // By kind of the cast.
    [[nodiscard]] std::vector<SpeciesFigures> species(DayPart part) const;
    // The highest peak of the autocorrelation of the school's path beyond its first zero, at lags
    // up to an hour and half the time; its lag is in seconds.
    [[nodiscard]] PathPeak pathPeak() const;
    [[nodiscard]] const WallExtent& extent() const { return extent_; }
    [[nodiscard]] const config::Day& day() const { return day_; }

  private:
    // The figures of a species in one part of the day, a value for each second.
    struct SpeciesSeconds {
        std::vector<float> nearestNeighbour, polarisation;
        std::array<std::uint64_t, kOccupations> occupationSeconds{};
        std::uint64_t fishSeconds = 0, swims = 0, atHome = 0;
    };
    void noteSecond(const world::World& world, const WallPose& pose);
    void noteSpecies(const world::World& world, DayPart part);
    static void noteFish(const world::World& world, std::uint32_t fish, SpeciesSeconds& species);

    const config::Rig& rig_;
    config::Day day_;
    WallExtent extent_;
    WallView view_;
    EventWatch watch_;
    std::vector<WallSecond> seconds_;
    std::array<std::vector<SpeciesSeconds>, kDayParts> species_;  // by kind
    std::vector<bool> livesAtASite_;                              // by kind
};

// CSV files; draw_wall.py draws tables and a figure from them.

// A line for each second.
[[nodiscard]] std::string secondsCsv(const WallStudy& study);
// A line for each measure: median and 5 % quantile, or the one value that it has, by day and night.
[[nodiscard]] std::string measuresCsv(const WallStudy& study);
// A line for each kind of event.
[[nodiscard]] std::string eventsCsv(const WallStudy& study);
// A line for each species and part of the day.
[[nodiscard]] std::string wallSpeciesCsv(const WallStudy& study,
                                         const world::World& world,
                                         std::span<const world::WorldSpecies> cast);

}  // namespace aquarama::study
