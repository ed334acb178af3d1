// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/feel_surroundings.h"

#include <algorithm>

#include "common/place/place.h"
#include "master/behaviour/home.h"
#include "master/behaviour/routines.h"
#include "master/surroundings/avoidance.h"

namespace aquarama::behaviour {

namespace {

// Obstacles are felt this time ahead at the present speed, and a little farther.
constexpr float kReachSeconds = 2.2F;
constexpr float kReachMetres = 0.4F;
// A submarine that approaches counts as larger by its way in this time.
constexpr float kBowWaveSeconds = 1.5F;
// Time for which the submarine is assumed to continue; a fish turns aside in two to four seconds.
constexpr float kSubmarineSeconds = 3.0F;
// Urgency for each unit of the submarine's push: half a push gives the greatest urgency.
constexpr float kHurry = 2.0F;

// From the middle of a fish to its ends, as a share of its length.
constexpr float kHalfBody = 0.5F;
// From the submarine's radius on, where its push begins.
constexpr float kSubmarineMarginMetres = 0.6F;

// Push of the submarine. Both move, so the path is that of the fish relative to the submarine. A
// submarine that approaches is felt from farther away.
glm::vec3 submarinePush(const surroundings::Submarine& submarine,
                        const Senses& senses,
                        float reach) {
    const glm::vec3 velocity = submarine.velocityMetresPerSecond;
    // A long body needs more room to turn.
    const float radius = submarine.radiusMetres + kHalfBody * senses.length;
    if (velocity == glm::vec3{})
        return surroundings::ballPush(submarine.position,
                                      radius,
                                      kSubmarineMarginMetres,
                                      senses.position,
                                      senses.heading,
                                      reach);
    const glm::vec3 past = senses.heading * reach - velocity * kSubmarineSeconds;
    const glm::vec3 towards = place::directionOf(senses.position - submarine.position, {});
    const float comingOn = std::max(0.0F, place::dot(velocity, towards));
    return surroundings::ballPush(submarine.position,
                                  radius + comingOn * kBowWaveSeconds,
                                  kSubmarineMarginMetres,
                                  senses.position,
                                  place::directionOf(past, senses.heading),
                                  place::lengthOf(past));
}

// A fish that goes down to turf feels obstacles so far ahead.
constexpr float kTurfReachMetres = 0.1F;
constexpr float kTurfReachSeconds = 0.3F;
// It has left the turf after so long.
constexpr std::uint32_t kLeavesTurfTicks = 180;

bool isAtTurf(const fish::Mind& mind) {
    const auto stage = static_cast<GrazeStage>(mind.stage);
    return fish::aimOf(mind).intention == fish::Intention::Graze &&
           (stage != GrazeStage::Travel || mind.sinceStage < kLeavesTurfTicks);
}

// Whether a predator rushes at the prey that it sees, and not from ambush. Turning aside for a
// moment does not end a rush.
bool rushesAtPrey(const fish::SpeciesParameters& parameters,
                  const fish::Mind& mind,
                  const Senses& senses) {
    return senses.prey.seen() && !parameters.habits.hunt.ambush &&
           fish::aimOf(mind).intention == fish::Intention::Eat &&
           mind.stage == static_cast<std::uint8_t>(HuntStage::Rush);
}

// How far ahead the fish feels obstacles.
float reachOf(const fish::SpeciesParameters& parameters,
              const fish::Mind& mind,
              const Senses& senses) {
    const float speed = std::max(0.0F, senses.speed);
    if (isAtTurf(mind)) return kTurfReachMetres + speed * kTurfReachSeconds;
    return kReachMetres + speed * std::max(kReachSeconds, parameters.turnSeconds);
}

// A hunter that a cue has released does not turn away from what is farther: it goes straight.
constexpr float kComingReachMetres = 1;
// Of a fish that lies in wait beside the reef.
constexpr surroundings::Berth kInWait{0.05F, 0.2F, 0.15F, 0.2F};
// Longer fish keep clear of the reef also at a cleaner's, metres.
constexpr float kLongestAtStation = 0.6F;

bool goesIntoShelter(const fish::Aim& aim) {
    return aim.intention == fish::Intention::Hide ||
           (aim.intention == fish::Intention::Rest && aim.target != fish::kNobody);
}

// Whether what it is about brings a fish near the reef.
bool goesToReef(const fish::Aim& aim, const Senses& senses) {
    return aim.intention == fish::Intention::Graze || aim.intention == fish::Intention::Charge ||
           (aim.intention == fish::Intention::Visit && senses.length < kLongestAtStation);
}

// The berth of a fish that nothing brings to the reef but its home or its post.
surroundings::Berth berthAtEase(const fish::SpeciesParameters& parameters,
                                std::uint32_t fish,
                                const Senses& senses) {
    const config::Home& home = parameters.habits.home;
    // One that lies in wait does so at several sites.
    if (parameters.habits.hunt.ambush) return home.site ? surroundings::kAtHome : kInWait;
    const bool isAtHome = home.site && !parameters.homes.empty() &&
                          place::lengthOf(homeOf(parameters, fish) - senses.position) <
                              static_cast<float>(home.leashMetres);
    return isAtHome ? surroundings::kAtHome : surroundings::berthOf(senses.length);
}

// How far the fish keeps from boulders and sand now.
surroundings::Berth berthFor(const fish::SpeciesParameters& parameters,
                             std::uint32_t fish,
                             const fish::Mind& mind,
                             const Senses& senses) {
    const fish::Aim aim = fish::aimOf(mind);
    if (goesIntoShelter(aim)) return surroundings::kIntoShelter;
    if (isAtTurf(mind)) return surroundings::kAtTurf;
    if (goesToReef(aim, senses)) return surroundings::kAtHome;
    return berthAtEase(parameters, fish, senses);
}

}  // namespace

void feelSurroundings(const Environment& environment,
                      const fish::SpeciesParameters& parameters,
                      std::uint32_t fish,
                      const fish::Mind& mind,
                      Senses& senses) {
    const surroundings::Surroundings& around = *environment.surroundings;
    const float reach = reachOf(parameters, mind, senses);
    const surroundings::Submarine& submarine = around.submarine;
    const glm::vec3 fromSubmarine = submarinePush(submarine, senses, reach);
    // One that rushes at prey feels no obstacle beyond it but the submarine: else all prey near a
    // border or the reef would be safe.
    const bool isComing = environment.released != nullptr && environment.released->has(fish);
    const float ahead = rushesAtPrey(parameters, mind, senses)
                            ? std::clamp(senses.prey.distance, kReachMetres, reach)
                        : isComing ? std::min(reach, kComingReachMetres)
                                   : reach;
    senses.push = surroundings::avoidance(around.obstacles,
                                          senses.position,
                                          senses.heading,
                                          ahead,
                                          berthFor(parameters, fish, mind, senses)) +
                  fromSubmarine;
    if (submarine.velocityMetresPerSecond != glm::vec3{})
        senses.hurry = std::min(1.0F, kHurry * place::lengthOf(fromSubmarine));
    senses.urgency = place::lengthOf(senses.push);
    senses.submarineMetres = place::lengthOf(submarine.position - senses.position);
}

}  // namespace aquarama::behaviour
