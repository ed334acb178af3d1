// SPDX-License-Identifier: Apache-2.0
#include "master/study/wall_study.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "capture/report/report_data.h"
#include "common/base/statistics.h"
#include "common/place/place.h"
#include "master/study/quantities.h"
#include "master/study/study.h"

namespace aquarama::study {

namespace {

constexpr auto kTicksOfSecond = static_cast<std::uint64_t>(kTicksPerSecond);
// The longest lag of the path's autocorrelation.
constexpr std::size_t kMostLagSeconds = 3600;

std::size_t indexOf(DayPart part) {
    return static_cast<std::size_t>(part);
}

double secondsOf(Tick tick) {
    return static_cast<double>(tick.value) / kTicksPerSecond;
}

// The share of a day that has passed since midnight.
double timeOfDay(const config::Day& day, Tick tick) {
    const double days = day.lengthSeconds > 0 ? secondsOf(tick) / day.lengthSeconds : 0;
    const double time = day.startsAt + days;
    return time - std::floor(time);
}

// Seconds since midnight; since tick 0 where the day stands still.
double secondOfDay(const config::Day& day, Tick tick) {
    if (day.lengthSeconds <= 0) return secondsOf(tick);
    return timeOfDay(day, tick) * day.lengthSeconds;
}

// All that may hide a fish: every rock of the place, also those out of the fish's water.
place::Obstacles sightOf(const world::World& world) {
    const place::Obstacles& obstacles = world.surroundings().obstacles;
    return {.place = obstacles.place,
            .water = obstacles.water,
            .rocks = place::rocksOf(obstacles.place)};
}

std::optional<glm::dvec3> centreOf(const fish::FishView& view,
                                   const fish::SpeciesParameters& species) {
    glm::dvec3 sum{};
    double there = 0;
    for (std::size_t fish = species.first; fish < species.last; ++fish) {
        if (view.shows(fish, fish::kAway)) continue;
        sum += glm::dvec3(view.position(fish));
        ++there;
    }
    return there > 0 ? std::optional(sum / there) : std::nullopt;
}

template <class Value>
Typical typicalOf(const std::vector<Value>& values) {
    return {static_cast<double>(quantile(values, 0.5)),
            static_cast<double>(quantile(values, 0.05))};
}

// `valueOf` of each second of a part of the day.
template <class ValueOf>
auto valuesOf(std::span<const WallSecond> seconds, DayPart part, ValueOf valueOf) {
    std::vector<decltype(valueOf(seconds.front()))> values;
    for (const WallSecond& second : seconds)
        if (second.part == part) values.push_back(valueOf(second));
    return values;
}

// Share of the seconds of a part of the day of which a claim is true.
template <class Claim>
double shareOf(std::span<const WallSecond> seconds, DayPart part, Claim claim) {
    const auto truths = valuesOf(seconds, part, claim);
    const auto number = static_cast<double>(std::ranges::count(truths, true));
    return truths.empty() ? 0 : number / static_cast<double>(truths.size());
}

// The longest run of seconds of a part of the day in which a third has no large fish.
std::uint64_t longestGap(std::span<const WallSecond> seconds, DayPart part, std::size_t third) {
    std::uint64_t longest = 0;
    std::uint64_t run = 0;
    for (const WallSecond& second : seconds) {
        const bool isGap = second.part == part && second.glance.large.at(third) == 0;
        run = isGap ? run + 1 : 0;
        longest = std::max(longest, run);
    }
    return longest;
}

bool isFull(const WallSecond& second, std::size_t third) {
    return second.glance.large.at(third) >= kFishOfAFullThird;
}

void addThirds(std::span<const WallSecond> seconds, DayPart part, WallFigures& figures) {
    for (std::size_t third = 0; third < kThirds; ++third) {
        figures.large.at(third) = typicalOf(valuesOf(seconds, part, [&](const WallSecond& second) {
            return second.glance.large.at(third);
        }));
        figures.full.at(third) =
            shareOf(seconds, part, [&](const WallSecond& second) { return isFull(second, third); });
        figures.gapSeconds.at(third) = longestGap(seconds, part, third);
    }
    figures.allFull = shareOf(seconds, part, [](const WallSecond& second) {
        return isFull(second, 0) && isFull(second, 1) && isFull(second, 2);
    });
}

void addEvents(std::span<const NotedEvent> events,
               const config::Day& day,
               DayPart part,
               WallFigures& figures) {
    if (figures.seconds == 0) return;
    const double minutes = static_cast<double>(figures.seconds) / 60;
    for (const NotedEvent& event : events) {
        if (!event.isInView || dayPartOf(day, event.tick) != part) continue;
        figures.eventsAMinute.at(static_cast<std::size_t>(event.kind)) += 1 / minutes;
        figures.allEventsAMinute += 1 / minutes;
    }
}

}  // namespace

DayPart dayPartOf(const config::Day& day, Tick tick) {
    const double time = timeOfDay(day, tick);
    return time >= 0.25 && time < 0.75 ? DayPart::Day : DayPart::Night;
}

WallFigures wallFiguresOf(std::span<const WallSecond> seconds,
                          std::span<const NotedEvent> events,
                          const config::Day& day,
                          DayPart part) {
    const auto typical = [&](auto WallGlance::*figure) {
        return typicalOf(valuesOf(
            seconds, part, [&](const WallSecond& second) { return second.glance.*figure; }));
    };
    WallFigures figures;
    const auto inView = valuesOf(seconds, part, [](const WallSecond& second) {
        return static_cast<double>(second.glance.inView);
    });
    figures.seconds = inView.size();
    for (const double fish : inView)
        figures.meanInView += fish / static_cast<double>(inView.size());
    figures.cellShare = typical(&WallGlance::cellShare);
    figures.inView = typical(&WallGlance::inView);
    figures.largestGroup = typical(&WallGlance::largestGroup);
    figures.species = typical(&WallGlance::species);
    figures.parts =
        typicalOf(valuesOf(seconds, part, [](const WallSecond& second) { return second.parts; }));
    addThirds(seconds, part, figures);
    addEvents(events, day, part, figures);
    return figures;
}

std::string wallLine(const WallFigures& figures) {
    const auto& full = figures.full;
    return fmt::format(
        "wall: cells {:.0f} %, thirds {:.0f} {:.0f} {:.0f} %, all {:.0f} %, gap {} s, largest "
        "school {:.0f} %, species {:.0f}, events {:.1f} a minute",
        100 * figures.cellShare.median,
        100 * full[0],
        100 * full[1],
        100 * full[2],
        100 * figures.allFull,
        std::ranges::max(figures.gapSeconds),
        100 * figures.largestGroup.median,
        figures.species.median,
        figures.allEventsAMinute);
}

WallStudy::WallStudy(const config::Rig& rig, const world::World& world)
    : rig_{rig},
      day_{world.surroundings().climate.day},
      extent_{rig},
      view_{extent_, sightOf(world), double{world.surroundings().clarityMetres}},
      watch_{watchedFishOf(world)} {
    species_.fill(std::vector<SpeciesSeconds>(world.speciesParameters().size()));
    for (const fish::SpeciesParameters& species : world.speciesParameters())
        livesAtASite_.push_back(species.habits.home.site.has_value());
}

void WallStudy::note(const world::World& world) {
    const std::uint64_t tick = world.tick().value;
    const bool isSecond = tick % kTicksOfSecond == 0;
    if (!isSecond && tick % EventWatch::kTicksBetweenLooks != 0) return;
    const WallPose pose = poseOf(world.pilot().vessel, rig_);
    watch_.note(watchedFishOf(world), [&](std::uint32_t fish) {
        return view_.seen(world.view(), fish, pose).has_value();
    });
    if (isSecond) noteSecond(world, pose);
}

void WallStudy::noteSecond(const world::World& world, const WallPose& pose) {
    const fish::FishView& view = world.view();
    const std::vector<SeenFish> seen = view_.allSeen(view, pose);
    const std::vector<std::uint32_t> groups = groupsOf(view);
    WallSecond second{.part = dayPartOf(day_, world.tick()),
                      .glance = glanceOf(seen, extent_, view, groups)};
    if (!world.speciesParameters().empty()) {
        const fish::SpeciesParameters& school = world.speciesParameters().front();
        second.parts = partsOf(view, school.first, school.last, groups);
        second.centre = centreOf(view, school);
    }
    seconds_.push_back(second);
    const EventWatch::Sees sees = [&](std::uint32_t fish) {
        return std::ranges::binary_search(seen, fish, {}, &SeenFish::fish);
    };
    watch_.noteSchools(watchedFishOf(world), groups, sees);
    watch_.noteClouds(watchedFishOf(world), sees);
    noteSpecies(world, second.part);
}

void WallStudy::noteSpecies(const world::World& world, DayPart part) {
    const fish::FishView& view = world.view();
    for (const fish::SpeciesParameters& parameters : world.speciesParameters()) {
        SpeciesSeconds& species = species_.at(indexOf(part))[parameters.kind];
        std::size_t there = 0;
        for (std::uint32_t fish = parameters.first; fish < parameters.last; ++fish) {
            if (view.shows(fish, fish::kAway)) continue;
            ++there;
            noteFish(world, fish, species);
        }
        if (there < 2) continue;
        const SchoolFigures figures = schoolFigures(view, parameters.first, parameters.last);
        species.nearestNeighbour.push_back(static_cast<float>(figures.nearestNeighbour));
        species.polarisation.push_back(static_cast<float>(figures.polarisation));
    }
}

void WallStudy::noteFish(const world::World& world, std::uint32_t fish, SpeciesSeconds& species) {
    const fish::VisibleFish& seen = world.view().fish[fish];
    const Occupation does =
        occupationOf({world.view(), world.minds(), world.speciesParameters()}, fish);
    ++species.occupationSeconds.at(static_cast<std::size_t>(does));
    ++species.fishSeconds;
    species.swims += std::abs(seen.speed) >= kSwimmingLengths * seen.length ? 1 : 0;
    const auto& site = world.speciesParameters()[world.view().kind[fish]].habits.home.site;
    const auto isNear = [&](const place::Site& of) {
        return site == of.kind &&
               glm::distance(of.place, seen.position) < kAtHomeMetres + of.sizeMetres / 2;
    };
    species.atHome += std::ranges::any_of(world.surroundings().sites, isNear) ? 1 : 0;
}

WallFigures WallStudy::figures(DayPart part) const {
    return wallFiguresOf(seconds_, events(), day_, part);
}

std::vector<SpeciesFigures> WallStudy::species(DayPart part) const {
    std::vector<SpeciesFigures> all;
    for (const SpeciesSeconds& species : species_.at(indexOf(part))) {
        SpeciesFigures figures{.nearestNeighbour = typicalOf(species.nearestNeighbour),
                               .polarisation = typicalOf(species.polarisation)};
        const auto shareOfTime = [&](std::uint64_t seconds) {
            return species.fishSeconds > 0
                       ? static_cast<double>(seconds) / static_cast<double>(species.fishSeconds)
                       : 0;
        };
        for (std::size_t i = 0; i < kOccupations; ++i)
            figures.occupationShare.at(i) = shareOfTime(species.occupationSeconds.at(i));
        figures.swims = shareOfTime(species.swims);
        if (livesAtASite_[all.size()]) figures.atHome = shareOfTime(species.atHome);
        all.push_back(figures);
    }
    return all;
}

// A second without any fish of the school is left out: all of them were eaten.
PathPeak WallStudy::pathPeak() const {
    std::vector<glm::dvec3> path;
    for (const WallSecond& second : seconds_)
        if (second.centre) path.push_back(*second.centre);
    if (path.size() < 2) return {};
    return highestPeak(autocorrelationOf(path, std::min(path.size() / 2, kMostLagSeconds)));
}

std::string secondsCsv(const WallStudy& study) {
    std::ostringstream csv;
    csv << "second,second_of_day,is_day,cells,left,middle,right,in_view,largest_group,species,"
           "parts,events\n";
    std::vector<std::uint32_t> events(study.seconds().size() + 1);
    for (const NotedEvent& event : study.events()) {
        const auto second = static_cast<std::size_t>(secondsOf(event.tick));
        if (event.isInView && second < events.size()) ++events[second];
    }
    std::size_t number = 0;
    for (const WallSecond& second : study.seconds()) {
        const WallGlance& glance = second.glance;
        report::addRow(csv,
                       number + 1,
                       secondOfDay(study.day(), {(number + 1) * kTicksOfSecond}),
                       second.part == DayPart::Day ? 1 : 0,
                       glance.cellShare,
                       glance.large[0],
                       glance.large[1],
                       glance.large[2],
                       glance.inView,
                       glance.largestGroup,
                       glance.species,
                       second.parts,
                       events[number]);
        ++number;
    }
    return csv.str();
}

namespace {

// A row of the measures: by day and by night the median and the 5 % quantile of a figure.
void addTypical(std::ostream& csv,
                const std::string& key,
                const std::array<WallFigures, kDayParts>& figures,
                const std::function<Typical(const WallFigures&)>& of) {
    csv << key;
    for (const WallFigures& part : figures) csv << ',' << of(part).median << ',' << of(part).low;
    csv << '\n';
}

// The same for a figure that has one value: the cells of quantiles are empty.
void addValue(std::ostream& csv,
              const std::string& key,
              const std::array<WallFigures, kDayParts>& figures,
              const std::function<double(const WallFigures&)>& of) {
    csv << key;
    for (const WallFigures& part : figures) csv << ',' << of(part) << ',';
    csv << '\n';
}

constexpr std::array<const char*, kThirds> kThirdNames{"left", "middle", "right"};

void addThirds(std::ostream& csv, const std::array<WallFigures, kDayParts>& figures) {
    for (std::size_t third = 0; third < kThirds; ++third) {
        const std::string name = kThirdNames.at(third);
        addTypical(csv, "large_" + name, figures, [&](const WallFigures& part) {
            return part.large.at(third);
        });
        addValue(csv, "full_" + name, figures, [&](const WallFigures& part) {
            return part.full.at(third);
        });
        addValue(csv, "gap_" + name, figures, [&](const WallFigures& part) {
            return static_cast<double>(part.gapSeconds.at(third));
        });
    }
    addValue(csv, "full_all", figures, [](const WallFigures& part) { return part.allFull; });
}

std::array<WallFigures, kDayParts> figuresByPart(const WallStudy& study) {
    return {study.figures(DayPart::Day), study.figures(DayPart::Night)};
}

}  // namespace

std::string measuresCsv(const WallStudy& study) {
    const std::array<WallFigures, kDayParts> figures = figuresByPart(study);
    std::ostringstream csv;
    csv << "measure,day,day_low,night,night_low\n";
    const auto typical = [&](const char* key, Typical WallFigures::*figure) {
        addTypical(csv, key, figures, [&](const WallFigures& part) { return part.*figure; });
    };
    addValue(csv, "seconds", figures, [](const WallFigures& part) {
        return static_cast<double>(part.seconds);
    });
    typical("cells", &WallFigures::cellShare);
    typical("in_view", &WallFigures::inView);
    addThirds(csv, figures);
    typical("largest_group", &WallFigures::largestGroup);
    typical("species", &WallFigures::species);
    typical("parts", &WallFigures::parts);
    addValue(csv, "events", figures, [](const WallFigures& part) { return part.allEventsAMinute; });
    addValue(csv, "mean_in_view", figures, [](const WallFigures& part) { return part.meanInView; });
    return csv.str();
}

std::string eventsCsv(const WallStudy& study) {
    const std::array<WallFigures, kDayParts> figures = figuresByPart(study);
    std::array<std::uint64_t, kWallEvents> all{};
    for (const NotedEvent& event : study.events()) ++all.at(static_cast<std::size_t>(event.kind));
    std::ostringstream csv;
    csv << "event,day_a_minute,night_a_minute,all\n";
    for (std::size_t kind = 0; kind < kWallEvents; ++kind)
        report::addRow(csv,
                       nameOf(static_cast<WallEvent>(kind)),
                       figures[0].eventsAMinute.at(kind),
                       figures[1].eventsAMinute.at(kind),
                       all.at(kind));
    return csv.str();
}

std::string wallSpeciesCsv(const WallStudy& study,
                           const world::World& world,
                           std::span<const world::WorldSpecies> cast) {
    std::ostringstream csv;
    csv << "species,fish,is_day,nearest,nearest_low,polarisation,polarisation_low,swims,at_home";
    for (std::size_t i = 0; i < kOccupations; ++i)
        csv << ',' << nameOf(static_cast<Occupation>(i)) << " share";
    csv << '\n';
    for (const DayPart part : kAllDayParts) {
        const std::vector<SpeciesFigures> species = study.species(part);
        for (const fish::SpeciesParameters& parameters : world.speciesParameters()) {
            const SpeciesFigures& figures = species[parameters.kind];
            csv << cast[parameters.kind].name << ',' << parameters.last - parameters.first << ','
                << (part == DayPart::Day ? 1 : 0) << ',' << figures.nearestNeighbour.median << ','
                << figures.nearestNeighbour.low << ',' << figures.polarisation.median << ','
                << figures.polarisation.low << ',' << figures.swims << ',';
            if (figures.atHome) csv << *figures.atHome;
            for (const double share : figures.occupationShare) csv << ',' << share;
            csv << '\n';
        }
    }
    return csv.str();
}

}  // namespace aquarama::study
