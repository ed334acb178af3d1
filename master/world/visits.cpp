// SPDX-License-Identifier: Apache-2.0
// Fish with visitors' drawings: how they come, how long they show themselves, and how they go.
#include <cassert>

#include "common/place/place.h"
#include "master/behaviour/guided.h"
#include "master/world/world.h"

namespace aquarama::world {

namespace {

// Longest times of the stages, in ticks. A fish that has not come to its place by then goes on.
constexpr std::uint64_t kEnters = 40 * 60;
constexpr std::uint64_t kShows = 8 * 60;
constexpr std::uint64_t kLeaves = 60 * 60;
// Behind the viewer by this much, or so far away, a fish that leaves is out of sight.
constexpr float kBehindMetres = 0.5F;
constexpr float kHazeMetres = 14;

void beginStage(fish::Wearer& wearer, fish::Visit visit, Tick tick) {
    wearer.visit = visit;
    wearer.since = tick;
}

}  // namespace

void World::enter(const EnterDrawing& drawing) {
    fish::Wearer* const wearer = wearers_.of(drawing.fish);
    if (wearer == nullptr || wearer->visit != fish::Visit::Asleep) return;
    wearer->aside = drawing.aside;
    wearer->number = drawing.number;
    wearer->picture = drawing.picture;
    beginStage(*wearer, fish::Visit::Enters, tick_);
    const glm::vec3 from = behaviour::entranceOf(wearers_, *wearer, surroundings_.obstacles);
    const glm::vec3 to = behaviour::greetingPlaceOf(wearers_, *wearer, surroundings_.obstacles);
    place(drawing.fish,
          from,
          place::directionOf(to - from, wearers_.ahead),
          speciesParameters_[columns_.view.kind[drawing.fish]].fast);
}

void World::leave(const LeaveDrawing& drawing) {
    fish::Wearer* const wearer = wearers_.of(drawing.fish);
    if (wearer == nullptr || wearer->visit == fish::Visit::Asleep) return;
    beginStage(*wearer, fish::Visit::Leaves, tick_);
}

void World::leadWearers() {
    for (fish::Wearer& wearer : wearers_.fish)
        if (wearer.visit != fish::Visit::Asleep) lead(wearer);
}

// From one stage to the next.
void World::lead(fish::Wearer& wearer) {
    const std::uint64_t ticks = tick_.value - wearer.since.value;
    const glm::vec3 position = columns_.view.position(wearer.fish);
    const glm::vec3 from = position - wearers_.eye;
    switch (wearer.visit) {
        case fish::Visit::Enters: {
            const glm::vec3 goal =
                behaviour::greetingPlaceOf(wearers_, wearer, surroundings_.obstacles);
            if (ticks > kEnters || behaviour::isAt(position, goal))
                beginStage(wearer, fish::Visit::Shows, tick_);
            return;
        }
        case fish::Visit::Shows:
            if (ticks > kShows) beginStage(wearer, fish::Visit::Stays, tick_);
            return;
        case fish::Visit::Leaves: {
            const bool isUnseen = place::dot(from, wearers_.ahead) < -kBehindMetres ||
                                  place::lengthOf(from) > kHazeMetres;
            const bool isAway = columns_.view.shows(wearer.fish, fish::kAway);
            if (!isUnseen && !isAway && ticks <= kLeaves) return;
            motion::setAway(columns_.states, wearer.fish);
            columns_.view.signs[wearer.fish] = fish::kAway;
            std::erase_if(absences_,
                          [&](const Absence& absence) { return absence.fish == wearer.fish; });
            wearer = {.fish = wearer.fish, .since = tick_};
            return;
        }
        case fish::Visit::Asleep:
        case fish::Visit::Stays:
            return;
    }
}

}  // namespace aquarama::world
