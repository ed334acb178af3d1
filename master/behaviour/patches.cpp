// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/patches.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "common/base/random_streams.h"
#include "common/place/place.h"
#include "master/behaviour/home.h"
#include "master/behaviour/loops.h"
#include "master/behaviour/routines.h"
#include "master/behaviour/territory.h"

namespace aquarama::behaviour {

namespace {

// A species that grazes for a share of its time does so in periods of this length.
constexpr std::uint64_t kTicksOfGrazing = std::uint64_t{40} * 60;

// A shoal goes on to a patch between these distances, where there is one; the value of a farther or
// nearer one is less. Of the value of a patch a share is drawn.
constexpr float kNearMetres = 3;
constexpr float kFarMetres = 8;
constexpr float kDrawn = 0.4F;

// On its loop a fish passes over one patch in so many.
constexpr std::uint32_t kSkipsOneIn = 8;

Sighting patchSighting(const surroundings::Turf& turf, std::uint32_t patch, glm::vec3 from) {
    const glm::vec3 offset = turf.patches[patch].place - from;
    return {patch, offset, place::lengthOf(offset)};
}

// Whether the household grazes now at all, by the share of its species.
bool grazesNow(const Environment& environment,
               const fish::SpeciesParameters& parameters,
               std::uint32_t fish) {
    const auto share = static_cast<float>(parameters.habits.graze->share);
    if (share >= 1) return true;
    const std::uint32_t drawn =
        hashOf(environment.seed, Stream::GrazingPeriods, fish::householdOf(parameters, fish).first);
    const std::uint64_t period =
        (environment.tick.value + drawn % kTicksOfGrazing) / kTicksOfGrazing;
    return unitOf(hashOf(drawn, static_cast<std::uint32_t>(period))) < share;
}

// Falls off to either side of the distances that a shoal likes to go.
float nearness(float metres) {
    if (metres < kNearMetres) return metres / kNearMetres;
    const float far = std::max(1.0F, metres / kFarMetres);
    return 1 / (far * far);
}

// How far a fish goes from its home to graze.
float grazingRange(const Environment& environment,
                   const fish::SpeciesParameters& parameters,
                   std::uint32_t fish) {
    if (parameters.homes.empty()) return std::numeric_limits<float>::infinity();
    return holdsTerritory(environment, parameters, fish)
               ? static_cast<float>(parameters.habits.territory->radiusMetres)
               : static_cast<float>(parameters.habits.home.leashMetres);
}

// Distance of a place from the home of a fish; 0 where it has none.
float awayFromHome(const fish::SpeciesParameters& parameters, std::uint32_t fish, glm::vec3 place) {
    return parameters.homes.empty() ? 0 : place::lengthOf(place - homeOf(parameters, fish));
}

// The patch of most value within reach of the fish: one that holds a territory or has a home stays
// by it. `present`: the one that it leaves.
std::uint32_t chosenPatch(const Environment& environment,
                          const fish::SpeciesParameters& parameters,
                          std::uint32_t fish,
                          std::uint32_t present,
                          const Senses& senses) {
    const surroundings::Turf& turf = environment.surroundings->turf;
    const float range = grazingRange(environment, parameters, fish);
    const std::uint32_t drawn = hashOf(hashOf(environment.seed, Stream::Patches, fish),
                                       static_cast<std::uint32_t>(environment.tick.value));
    const glm::vec3 from = parameters.homes.empty() ? senses.position : homeOf(parameters, fish);
    std::uint32_t best = 0;
    float most = -std::numeric_limits<float>::infinity();
    const auto weigh = [&](std::uint32_t patch) {
        const glm::vec3 place = turf.patches[patch].place;
        const float away = awayFromHome(parameters, fish, place);
        const float fill = turf.shareOf(patch);
        float value = fill * fill * nearness(place::lengthOf(place - senses.position)) *
                      (1 - kDrawn * unitOf(hashOf(drawn, patch)));
        if (patch == present) value = 0;
        // None within its range: the one nearest to its home.
        if (away > range) value = -away;
        if (value < most || (value == most && patch > best)) return;
        most = value;
        best = patch;
    };
    const PlacesKnown& known = environment.grids->turf;
    known.visit(from, range * range, turf.patches.size(), weigh);
    if (most >= 0) return best;
    PlacesKnown::findOutwards([&](float reachSquared) {
        known.visit(from, reachSquared, turf.patches.size(), weigh);
        return -most * -most <= reachSquared;
    });
    return best;
}

// The patch after the present one on its round, or the one after that; the nearest where it is at
// none of them.
std::uint32_t nextOfLoop(const Environment& environment,
                         const fish::SpeciesParameters& parameters,
                         std::uint32_t fish,
                         std::uint32_t present,
                         const Senses& senses) {
    const surroundings::Turf& turf = environment.surroundings->turf;
    const Loop* const made = environment.grids->loops.of(parameters, fish);
    const Loop loop = made == nullptr ? loopOf(turf, environment.seed, fish) : *made;
    const auto at = std::ranges::find(loop.all(), present);
    if (at == loop.all().end())
        return *std::ranges::min_element(loop.all(), {}, [&](std::uint32_t patch) {
            return place::lengthOf(turf.patches[patch].place - senses.position);
        });
    const std::uint32_t drawn = hashOf(hashOf(environment.seed, Stream::Loops, fish),
                                       static_cast<std::uint32_t>(environment.tick.value));
    const std::size_t step = drawn % kSkipsOneIn == 0 ? 2 : 1;
    const auto index = static_cast<std::size_t>(at - loop.all().begin());
    return loop.patches[(index + step) % loop.count];
}

// Whether the fish grazes now, and there is turf.
bool mayGraze(const Environment& environment,
              const fish::SpeciesParameters& parameters,
              std::uint32_t fish) {
    return parameters.habits.graze && !environment.surroundings->turf.patches.empty() &&
           grazesNow(environment, parameters, fish);
}

// The patch that a fish grazes at or goes to already.
std::uint32_t presentPatch(const surroundings::Turf& turf, const fish::Mind& mind) {
    const fish::Aim aim = fish::aimOf(mind);
    const bool has = aim.intention == fish::Intention::Graze && aim.target < turf.patches.size();
    return has ? aim.target : fish::kNobody;
}

}  // namespace

std::uint32_t leaderOf(const fish::FishView& view,
                       const fish::SpeciesParameters& parameters,
                       std::uint32_t fish) {
    if (parameters.habits.graze->manner == config::GrazeManner::Loop) return fish;
    const fish::Household household = fish::householdOf(parameters, fish);
    for (std::uint32_t leader = household.first;
         leader < std::min(household.last, household.first + 2);
         ++leader) {
        if (view.shows(leader, fish::kAway)) continue;
        if (leader == fish || view.patch[leader] != fish::kNobody) return leader;
    }
    return fish;
}

Sighting patchFor(const Environment& environment,
                  const fish::SpeciesParameters& parameters,
                  std::uint32_t fish,
                  const fish::Mind& mind,
                  const Senses& senses) {
    const surroundings::Turf& turf = environment.surroundings->turf;
    if (!mayGraze(environment, parameters, fish)) return {};
    const std::uint32_t present = presentPatch(turf, mind);
    const std::uint32_t leader = leaderOf(*environment.view, parameters, fish);
    if (leader != fish)
        return patchSighting(turf, environment.view->patch[leader], senses.position);
    if (present != fish::kNobody && mind.stage != static_cast<std::uint8_t>(GrazeStage::Done))
        return patchSighting(turf, present, senses.position);
    const bool loops = parameters.habits.graze->manner == config::GrazeManner::Loop;
    return patchSighting(turf,
                         loops ? nextOfLoop(environment, parameters, fish, present, senses)
                               : chosenPatch(environment, parameters, fish, present, senses),
                         senses.position);
}

}  // namespace aquarama::behaviour
