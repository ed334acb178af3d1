// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/territory.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "common/base/random_streams.h"
#include "common/base/units.h"
#include "common/place/place.h"
#include "master/behaviour/home.h"
#include "master/behaviour/intention_generator.h"
#include "master/behaviour/points_within.h"
#include "master/behaviour/routines.h"
#include "master/surroundings/avoidance.h"

namespace aquarama::behaviour {

namespace {

// Lengths of whom an owner charges, in its own.
constexpr float kLeastLength = 0.6F;
constexpr float kMostLength = 1.7F;
// A charge goes this far past the border, the rest drawn, and lasts so long at most.
constexpr float kPastMetres = 1;
constexpr float kPastSpread = 1;
constexpr std::uint32_t kMostTicks = 4 * 60;
// Who is nearer than this, in lengths of the owner, was touched.
constexpr float kTouches = 0.5F;
// A charge begins with a fast start in this time, where there is so much room.
constexpr std::uint32_t kChargeStartTicks = 16;
// The owner aims at where the intruder will be.
constexpr float kLeadSeconds = 0.2F;

float radiusOf(const fish::SpeciesParameters& parameters) {
    return static_cast<float>(parameters.habits.territory->radiusMetres);
}

bool livesWith(const fish::SpeciesParameters& parameters, std::uint32_t fish, std::uint32_t other) {
    const fish::Household household = fish::householdOf(parameters, fish);
    return other >= household.first && other < household.last;
}

// Whether the charge that is under way goes on.
bool goesOn(const Environment& environment,
            const fish::SpeciesParameters& parameters,
            std::uint32_t fish,
            const fish::Mind& mind,
            const Sighting& intruder,
            const Senses& senses) {
    const std::uint32_t own =
        hashOf(hashOf(environment.seed, Stream::Owners, fish), intruder.object);
    const float past = kPastMetres + kPastSpread * unitOf(own);
    const float from = place::lengthOf(senses.position - homeOf(parameters, fish));
    return mind.pursued < kMostTicks && from < radiusOf(parameters) + past &&
           intruder.distance > kTouches * senses.length &&
           intruder.distance < radiusOf(parameters) + past;
}

// Whether the owner of a territory charges another fish that comes into it.
bool isExpelled(const fish::FishView& view,
                const fish::SpeciesParameters& parameters,
                std::uint32_t fish,
                std::uint32_t other,
                float ownLength) {
    if ((parameters.expels >> view.kind[other] & 1U) == 0 || view.shows(other, fish::kAway) ||
        livesWith(parameters, fish, other))
        return false;
    const float length = view.fish[other].length / ownLength;
    return length >= kLeastLength && length <= kMostLength;
}

// The nearest of the intruders; nothing where they are too many.
Sighting nearestIntruder(const Environment& environment,
                         const fish::SpeciesParameters& parameters,
                         std::uint32_t fish,
                         const Senses& senses) {
    const fish::FishView& view = *environment.view;
    const glm::vec3 home = homeOf(parameters, fish);
    const float radius = radiusOf(parameters);
    Sighting nearest;
    std::uint32_t count = 0;
    const auto weigh = [&](std::uint32_t other, glm::vec3 fromHome, float squared) {
        if (squared > radius * radius || !isExpelled(view, parameters, fish, other, senses.length))
            return;
        ++count;
        const glm::vec3 offset = home + fromHome - senses.position;
        const Sighting intruder{other, offset, place::lengthOf(offset)};
        if (isNearer(intruder, nearest)) nearest = intruder;
    };
    visitPointsWithin(environment.grids->fish, home, radius * radius, weigh);
    return count > kMostCharged ? Sighting{} : nearest;
}

// The intruder that the owner charges already, while the charge goes on.
Sighting presentIntruder(const Environment& environment,
                         const fish::SpeciesParameters& parameters,
                         std::uint32_t fish,
                         const fish::Mind& mind,
                         const Senses& senses) {
    const std::uint32_t target = fish::aimOf(mind).target;
    const Sighting intruder = sightingOf(*environment.view, target, senses.position);
    const bool goes = !environment.view->shows(target, fish::kAway) &&
                      goesOn(environment, parameters, fish, mind, intruder, senses);
    return goes ? intruder : Sighting{};
}

bool isChargedBy(const fish::FishView& view, std::uint32_t fish, std::uint32_t other) {
    return other < view.size() && view.charged[other] == fish && !view.shows(other, fish::kAway);
}

// Who charges the fish: the one that it flees, or a neighbour.
Sighting chargerOf(const fish::FishView& view,
                   std::uint32_t fish,
                   const fish::Mind& mind,
                   const Senses& senses) {
    if (mind.intention == fish::Intention::Escape && isChargedBy(view, fish, mind.target))
        return sightingOf(view, mind.target, senses.position);
    for (const Neighbours* those : {&senses.schoolmates, &senses.others})
        for (std::size_t i = 0; i < those->count; ++i)
            if (isChargedBy(view, fish, those->fish[i]))
                return sightingOf(view, those->fish[i], senses.position);
    return {};
}

}  // namespace

bool holdsTerritory(const Environment& environment,
                    const fish::SpeciesParameters& parameters,
                    std::uint32_t fish) {
    const config::Habits& habits = parameters.habits;
    if (!habits.territory || parameters.homes.empty()) return false;
    const fish::Household household = fish::householdOf(parameters, fish);
    const bool shoals = habits.graze && habits.graze->manner == config::GrazeManner::Shoal;
    if (shoals && household.last - household.first > 1) return false;
    return unitOf(hashOf(environment.seed, Stream::Owners, fish)) <
           static_cast<float>(habits.territory->share);
}

void senseTerritory(const Environment& environment,
                    const fish::SpeciesParameters& parameters,
                    std::uint32_t fish,
                    const fish::Mind& mind,
                    Senses& senses) {
    const fish::FishView& view = *environment.view;
    if (parameters.expelledBy != 0) senses.territory.charger = chargerOf(view, fish, mind, senses);
    senses.territory.holds = holdsTerritory(environment, parameters, fish);
    if (!senses.territory.holds) return;
    const fish::Aim aim = fish::aimOf(mind);
    if (aim.intention == fish::Intention::Charge && aim.target < view.size()) {
        senses.territory.intruder = presentIntruder(environment, parameters, fish, mind, senses);
        return;
    }
    const float rest = kRefractorySeconds * static_cast<float>(kTicksPerSecond);
    if (static_cast<float>(mind.sinceCharge) >= rest)
        senses.territory.intruder = nearestIntruder(environment, parameters, fish, senses);
}

fish::Course charge(const Situation& situation, const fish::Mind& mind, DeferredEvents& events) {
    assert(situation.senses.territory.intruder.seen());
    const fish::FishView& view = *situation.environment.view;
    const Sighting& intruder = situation.senses.territory.intruder;
    if (mind.pursued == 0)
        events.push_back({fish::DeferredEventKind::Charge, situation.fish, intruder.object});
    const glm::vec3 theirs =
        view.heading(intruder.object) * (view.fish[intruder.object].speed * kLeadSeconds);
    fish::Course course{steeply(place::directionOf(intruder.offset + theirs + wayRound(situation),
                                                   situation.senses.heading)),
                        situation.parameters.fast,
                        std::max(situation.senses.urgency, 1.0F)};
    course.startsFast = mind.pursued < kChargeStartTicks &&
                        hasRoom(situation, course.direction, kStartLengths, surroundings::kAtHome);
    return course;
}

}  // namespace aquarama::behaviour
