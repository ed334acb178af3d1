// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/ways.h"

#include <algorithm>
#include <array>
#include <limits>

#include "common/base/random_streams.h"
#include "common/base/units.h"
#include "common/place/place.h"

namespace aquarama::behaviour {

namespace {

constexpr std::uint32_t kBoldOneIn = 12;
// A bold fish stays with a structure for so long.
constexpr std::uint32_t kShortestStayTicks = 40 * 60;
constexpr std::uint32_t kStaySpreadTicks = 50 * 60;
// The weight of a structure falls to half at this distance; one nearer than kLeftMetres to a fish
// that chooses anew counts for little.
constexpr float kHalfMetres = 6;
constexpr float kLeftMetres = 2.5F;
constexpr float kLeftWeight = 0.1F;

// Schools keep off a crown: most liked between kWayNearMetres and kWayFarMetres from it, not at all
// from kGoneMetres on.
constexpr float kWayNearMetres = 0.8F;
constexpr float kWayFarMetres = 3;
constexpr float kGoneMetres = 6.5F;

// A school tires of a place at which all its bold fish stay in so many seconds, and forgets that,
// and a fright, in so many.
constexpr float kTiresSeconds = 90;
constexpr float kForgetsSeconds = 300;
constexpr float kCalmsSeconds = 90;
// A fish is beside a structure within this distance of its crown, beyond the radius.
constexpr float kBesideMetres = 3;
constexpr std::uint32_t kTicksOfSecond = 60;
// Fright by one alarmed fish in a second.
constexpr float kFrightOfOne = 0.25F;
// How much of the liking is lost at most.
constexpr float kTiredShare = 0.8F;

// A school stands so far over a crown and up-current of it.
constexpr float kOverMetres = 0.9F;
constexpr float kUpCurrentMetres = 1.6F;
// A bold fish is there within this distance.
constexpr float kWayThereMetres = 1.2F;
// Weights against the unit vector of the present course: of the way to the structure, and of the
// course against the current.
constexpr float kLead = 1.6F;
constexpr float kHold = 0.6F;
// A bold fish leads with full weight if so many schoolmates are near.
constexpr std::size_t kFollowers = 2;
// A school holds its place in a current above this (m/s) where it likes to be.
constexpr float kHoldsFrom = 0.03F;
constexpr float kLikes = 0.6F;

// The share of the liking for a structure that is left by what schools remember of it.
float remembered(const surroundings::Structure& structure) {
    return (1 - kTiredShare * structure.tiredOf) * (1 - structure.fright);
}

// How much a tick of one of these fish counts for those that are beside the structures: by tiring
// where it is bold, and by fright where it is alarmed.
void countOne(const Environment& environment,
              const fish::SpeciesParameters& parameters,
              std::uint32_t fish,
              std::vector<surroundings::Structure>& structures) {
    const fish::FishView& view = *environment.view;
    if (!view.shows(fish, fish::kSchooling)) return;
    const bool isAlarmed = view.shows(fish, fish::kAlarmed);
    const bool isLeading = isBold(environment.seed, fish);
    if (!isAlarmed && !isLeading) return;
    const float bold = std::max(
        1.0F,
        static_cast<float>(parameters.last - parameters.first) / static_cast<float>(kBoldOneIn));
    for (surroundings::Structure& structure : structures) {
        const float reach = structure.radiusMetres + kBesideMetres;
        const glm::vec3 from = view.position(fish) - structure.crown;
        if (place::dot(from, from) > reach * reach) continue;
        if (isLeading)
            structure.tiredOf = std::min(1.0F, structure.tiredOf + 1 / (kTiresSeconds * bold));
        if (isAlarmed) structure.fright = std::min(1.0F, structure.fright + kFrightOfOne);
    }
}

}  // namespace

void rememberPlaces(const Environment& environment,
                    std::vector<surroundings::Structure>& structures) {
    for (surroundings::Structure& structure : structures) {
        structure.tiredOf *= 1 - 1 / (kForgetsSeconds * kTicksOfSecond);
        structure.fright *= 1 - 1 / (kCalmsSeconds * kTicksOfSecond);
    }
    if (structures.empty()) return;
    const auto turn = static_cast<std::uint32_t>(environment.tick.value % kTicksOfSecond);
    for (const fish::SpeciesParameters& parameters : environment.speciesParameters)
        for (std::uint32_t fish = parameters.first + turn; fish < parameters.last;
             fish += kTicksOfSecond)
            countOne(environment, parameters, fish, structures);
}

bool isBold(std::uint32_t seed, std::uint32_t fish) {
    return hashOf(seed, Stream::Bold, fish) % kBoldOneIn == 0;
}

std::uint32_t structureFor(const Environment& environment,
                           const fish::Mind& mind,
                           std::uint32_t fish,
                           const Senses& senses) {
    const std::vector<surroundings::Structure>& structures = environment.surroundings->structures;
    if (structures.empty() || !isBold(environment.seed, fish)) return fish::kNobody;
    const fish::Aim aim = fish::aimOf(mind);
    const std::uint32_t own = hashOf(environment.seed, Stream::Ways, fish);
    const bool has = aim.intention == fish::Intention::School && aim.target < structures.size();
    const std::uint32_t stays = kShortestStayTicks + hashOf(own, aim.target) % kStaySpreadTicks;
    if (has && mind.pursued < stays && mind.alarm == fish::Alarm::Calm) return aim.target;
    std::array<float, surroundings::kMostStructures> weights{};
    float sum = 0;
    for (std::size_t i = 0; i < structures.size(); ++i) {
        const float distance = place::lengthOf(structures[i].crown - senses.position);
        const float far = distance / kHalfMetres;
        weights[i] = structures[i].liking * remembered(structures[i]) / (1 + far * far);
        if (distance < kLeftMetres || (has && i == aim.target)) weights[i] *= kLeftWeight;
        sum += weights[i];
    }
    float left = sum * unitOf(hashOf(own, static_cast<std::uint32_t>(environment.tick.value)));
    for (std::uint32_t i = 0; i < structures.size(); ++i) {
        left -= weights[i];
        if (left <= 0) return i;
    }
    return static_cast<std::uint32_t>(structures.size() - 1);
}

Liking likingOf(const surroundings::Surroundings& surroundings, glm::vec3 place) {
    float nearest = std::numeric_limits<float>::infinity();
    float share = 0;
    for (const surroundings::Structure& structure : surroundings.structures) {
        const float away = place::lengthOf(structure.crown - place) - structure.radiusMetres;
        if (away >= nearest) continue;
        nearest = away;
        share = remembered(structure);
    }
    const float near = std::clamp(nearest / kWayNearMetres, 0.0F, 1.0F);
    const float far =
        std::clamp((kGoneMetres - nearest) / (kGoneMetres - kWayFarMetres), 0.0F, 1.0F);
    return {near * far, near * far * share};
}

glm::vec3 ownWay(const Situation& situation) {
    const Senses& senses = situation.senses;
    const surroundings::Surroundings& around = *situation.environment.surroundings;
    const glm::vec3 current = around.current.at(senses.position, around.openCurrent);
    const glm::vec3 against = place::directionOf(-current, {});
    const bool flows = place::lengthOf(current) > kHoldsFrom;
    glm::vec3 way{};
    if (senses.structure < around.structures.size()) {
        const surroundings::Structure& structure = around.structures[senses.structure];
        const place::Region& water = around.obstacles.water;
        glm::vec3 goal = structure.crown + glm::vec3{0, kOverMetres, 0};
        if (flows) goal += against * (structure.radiusMetres + kUpCurrentMetres);
        goal.y = std::min(goal.y, water.centre.y + 0.6F * water.halfExtent.y);
        const glm::vec3 towards = goal - senses.position;
        // A bold fish leads; it does not leave alone.
        const float followed = std::min(
            1.0F, static_cast<float>(senses.schoolmates.count) / static_cast<float>(kFollowers));
        if (place::lengthOf(towards) > kWayThereMetres)
            way += place::directionOf(towards, {}) * (kLead * followed);
    }
    if (flows && likingOf(around, senses.position).now > kLikes) way += against * kHold;
    return way;
}

}  // namespace aquarama::behaviour
