// SPDX-License-Identifier: Apache-2.0
#include "master/world/visits.h"

#include <algorithm>

#include "common/base/random_streams.h"
#include "common/place/place.h"
#include "master/behaviour/guided.h"
#include "master/behaviour/think.h"
#include "master/surroundings/pilot.h"
#include "master/world/beginning.h"

namespace aquarama::world {

namespace {

// Longest times of the stages, in ticks. A fish that has not come to its place by then goes on.
constexpr std::uint64_t kEnters = 40 * 60;
constexpr std::uint64_t kShows = 8 * 60;
constexpr std::uint64_t kLeaves = 60 * 60;
// Behind the viewer by this much, or so far away, a fish that leaves is out of sight.
constexpr float kBehindMetres = 0.5F;
constexpr float kOutOfSightMetres = 14;

void begin(fish::Wearer& wearer, fish::Visit visit, Tick tick) {
    wearer.visit = visit;
    wearer.since = tick;
}

glm::vec3 placeOf(const FishColumns& columns, const fish::Wearer& wearer) {
    return motion::bodyFrameOf(columns.states, wearer.fish).position;
}

// Whether a fish is where its viewer does not see it.
bool isUnseen(const fish::Wearers& wearers, glm::vec3 position) {
    const glm::vec3 from = position - wearers.eye;
    return place::dot(from, wearers.ahead) < -kBehindMetres ||
           place::lengthOf(from) > kOutOfSightMetres;
}

// Out of sight, or too long on its way there.
bool hasLeft(const FishColumns& columns, const fish::Wearer& wearer, std::uint64_t ticks) {
    return ticks > kLeaves || columns.view.shows(wearer.fish, fish::kAway) ||
           isUnseen(columns.wearers, placeOf(columns, wearer));
}

// Its return after it was eaten, if that was under way, is off.
void sleep(FishColumns& columns, fish::Wearer& wearer, Tick tick, std::vector<Absence>& absences) {
    motion::setAway(columns.states, wearer.fish);
    columns.placements.note(wearer.fish, tick);
    columns.view.signs[wearer.fish] = fish::kAway;
    std::erase_if(absences, [&](const Absence& absence) { return absence.fish == wearer.fish; });
    wearer = {.fish = wearer.fish, .since = tick};
}

bool hasCome(const WaterAtTick& water, const FishColumns& columns, const fish::Wearer& wearer) {
    return behaviour::isAt(
        placeOf(columns, wearer),
        behaviour::greetingPlaceOf(columns.wearers, wearer, water.surroundings.obstacles));
}

}  // namespace

void putIn(const WaterAtTick& water,
           std::uint32_t fish,
           glm::vec3 place,
           glm::vec3 course,
           float speed,
           FishColumns& columns) {
    placeFishAt(columns.states, fish, place, course);
    columns.placements.note(fish, water.tick);
    motion::setSpeedBodyLengths(columns.states, fish, speed);
    const auto drawn = hashOf(water.seed, static_cast<std::uint32_t>(water.tick.value));
    columns.minds[fish] = behaviour::freshMind(water.speciesParameters[columns.view.kind[fish]],
                                               drawn,
                                               fish,
                                               columns.view.fish[fish].length);
    columns.courses[fish] = {place::levelled(course), speed, 0};
    columns.view.signs[fish] = 0;
}

void lookFrom(const surroundings::Vessel& vessel, fish::Wearers& wearers) {
    wearers.eye = vessel.position;
    wearers.right = surroundings::rightOf(vessel.attitude);
    wearers.ahead = {wearers.right.z, 0, -wearers.right.x};
}

float fastestWith(const FishColumns& columns,
                  std::span<const fish::SpeciesParameters> speciesParameters) {
    constexpr float kShare = 0.4F;  // of its speed: it catches up with the rest
    float fastest = surroundings::kNoLimit;
    for (const fish::Wearer& wearer : columns.wearers.fish) {
        if (wearer.visit != fish::Visit::Enters && wearer.visit != fish::Visit::Shows) continue;
        const float own = speciesParameters[columns.view.kind[wearer.fish]].fast *
                          columns.view.fish[wearer.fish].length;
        fastest = std::min(fastest, kShare * own);
    }
    return fastest;
}

void enter(const WaterAtTick& water, const EnterDrawing& drawing, FishColumns& columns) {
    fish::Wearer* const wearer = columns.wearers.of(drawing.fish);
    if (wearer == nullptr || wearer->visit != fish::Visit::Asleep) return;
    wearer->aside = drawing.aside;
    wearer->number = drawing.number;
    wearer->picture = drawing.picture;
    begin(*wearer, fish::Visit::Enters, water.tick);
    const place::Obstacles& obstacles = water.surroundings.obstacles;
    const glm::vec3 from = behaviour::entranceOf(columns.wearers, *wearer, obstacles);
    const glm::vec3 to = behaviour::greetingPlaceOf(columns.wearers, *wearer, obstacles);
    putIn(water,
          drawing.fish,
          from,
          place::directionOf(to - from, columns.wearers.ahead),
          water.speciesParameters[columns.view.kind[drawing.fish]].fast,
          columns);
}

void leave(const LeaveDrawing& drawing, Tick tick, FishColumns& columns) {
    fish::Wearer* const wearer = columns.wearers.of(drawing.fish);
    if (wearer != nullptr && wearer->visit != fish::Visit::Asleep)
        begin(*wearer, fish::Visit::Leaves, tick);
}

void leadWearers(const WaterAtTick& water, FishColumns& columns, std::vector<Absence>& absences) {
    for (fish::Wearer& wearer : columns.wearers.fish) {
        const std::uint64_t ticks = water.tick.value - wearer.since.value;
        using enum fish::Visit;
        if (wearer.visit == Enters && (ticks > kEnters || hasCome(water, columns, wearer)))
            begin(wearer, Shows, water.tick);
        else if (wearer.visit == Shows && ticks > kShows)
            begin(wearer, Stays, water.tick);
        else if (wearer.visit == Leaves && hasLeft(columns, wearer, ticks))
            sleep(columns, wearer, water.tick, absences);
    }
}

}  // namespace aquarama::world
