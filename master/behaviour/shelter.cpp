// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/shelter.h"

#include <algorithm>

#include <glm/common.hpp>

#include "common/base/random_streams.h"
#include "common/place/place.h"
#include "master/behaviour/home.h"
#include "master/behaviour/routines.h"

namespace aquarama::behaviour {

namespace {

// From its home, no shelter for a night is farther.
constexpr float kFarthestBedMetres = 4;
// A site costs up to this share more, drawn by fish and site: so not all dive into the same one.
constexpr float kOwnTaste = 0.5F;
// Mean time until a hidden fish ventures out: after a predator that passed, and after one that
// rushed.
constexpr float kHiddenSeconds = 4;
constexpr float kHiddenFromRushSeconds = 15;

// A fish can rest at a site where the border of the water does not turn it away.
constexpr float kWithinMetres = 0.15F;
bool isInReach(const place::Region& water, glm::vec3 site) {
    const glm::vec3 inside = water.halfExtent - glm::abs(site - water.centre);
    return std::min({inside.x, inside.y, inside.z}) > kWithinMetres;
}

// How many of its schoolmates near by dive.
std::size_t divingSchoolmates(const Onlooker& onlooker) {
    const Neighbours& schoolmates = onlooker.senses.schoolmates;
    std::size_t diving = 0;
    for (std::size_t i = 0; i < schoolmates.count; ++i)
        diving +=
            static_cast<std::size_t>(onlooker.view().shows(schoolmates.fish[i], fish::kDiving));
    return diving;
}

bool hides(const Onlooker& onlooker) {
    return onlooker.aim.intention == fish::Intention::Hide;
}

bool restsOrIsAboutTo(const Onlooker& onlooker) {
    return onlooker.senses.hour.rests || onlooker.aim.intention == fish::Intention::Rest;
}

// Whether it is in a shelter or wants one.
bool needsShelter(const Onlooker& onlooker) {
    return onlooker.senses.predatorCount > 0 || onlooker.senses.shelter.diving > 0 ||
           hides(onlooker) || restsOrIsAboutTo(onlooker);
}

// Whether it aims at a shelter already.
bool hasShelter(const Onlooker& onlooker) {
    return (hides(onlooker) || restsOrIsAboutTo(onlooker)) &&
           onlooker.aim.target < onlooker.environment.surroundings->sites.size();
}

// Whether a hidden fish ventures out at this thought, by a draw.
bool venturesOut(const Onlooker& onlooker) {
    const bool rushed = isFromRush(static_cast<HideStage>(onlooker.mind.stage));
    const float perThought =
        static_cast<float>(fish::kTicksBetweenThoughts) / static_cast<float>(kTicksPerSecond);
    const std::uint32_t own = hashOf(onlooker.environment.seed, Stream::VenturesOut, onlooker.fish);
    return unitOf(hashOf(own, static_cast<std::uint32_t>(onlooker.environment.tick.value))) *
               (rushed ? kHiddenFromRushSeconds : kHiddenSeconds) <
           perThought;
}

Sighting siteFrom(const Onlooker& onlooker, std::uint32_t site) {
    const glm::vec3 offset =
        onlooker.environment.surroundings->sites[site].place - onlooker.senses.position;
    return {site, offset, place::lengthOf(offset)};
}

// Where a fish looks for a shelter: within so many metres of a place.
struct ShelterRange {
    glm::vec3 from{};
    float metres = 0;
};
// To rest it goes to a shelter near its home, which it knows, else to one that it sees.
ShelterRange shelterRangeOf(const Onlooker& onlooker) {
    if (restsOrIsAboutTo(onlooker) && !onlooker.parameters.homes.empty())
        return {homeOf(onlooker.parameters, onlooker.fish), kFarthestBedMetres};
    return {onlooker.senses.position, onlooker.sight(1)};
}

bool isFitShelter(const Onlooker& onlooker, const place::Site& site) {
    const std::vector<config::SiteKind>& kinds = onlooker.parameters.habits.hidesIn;
    if (std::ranges::find(kinds, site.kind) == kinds.end()) return false;
    return !restsOrIsAboutTo(onlooker) ||
           isInReach(onlooker.environment.surroundings->obstacles.water, site.place);
}

// The shelter of least way; of equally far ones the first.
Sighting nearestShelter(const Onlooker& onlooker) {
    const std::vector<place::Site>& sites = onlooker.environment.surroundings->sites;
    const ShelterRange range = shelterRangeOf(onlooker);
    float least = range.metres;
    float leastSquared = least * least;
    std::uint32_t nearest = fish::kNobody;
    const auto weigh = [&](std::uint32_t site) {
        if (!isFitShelter(onlooker, sites[site])) return;
        const float cost = place::lengthOf(sites[site].place - range.from) *
                           (1 + kOwnTaste * unitOf(hashOf(sites[site].seed, onlooker.fish)));
        // Nobody is the highest index; a shelter at the limit is too far.
        const bool isFirst = cost == least && least < range.metres && site < nearest;
        if (cost >= least && !isFirst) return;
        least = cost;
        leastSquared = cost * cost;
        nearest = site;
    };
    onlooker.environment.grids->sites.visit(range.from, leastSquared, sites.size(), weigh);
    return nearest == fish::kNobody ? Sighting{} : siteFrom(onlooker, nearest);
}

}  // namespace

void senseShelter(const Onlooker& onlooker) {
    if (onlooker.parameters.habits.hidesIn.empty()) return;
    ShelterSenses& shelter = onlooker.senses.shelter;
    shelter.diving = divingSchoolmates(onlooker);
    if (!needsShelter(onlooker)) return;
    if (hasShelter(onlooker)) {
        shelter.site = siteFrom(onlooker, onlooker.aim.target);
        shelter.venturesOut = hides(onlooker) && venturesOut(onlooker);
        return;
    }
    shelter.site = nearestShelter(onlooker);
}

}  // namespace aquarama::behaviour
