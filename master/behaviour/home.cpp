// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/home.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "common/base/random_streams.h"
#include "common/place/place.h"
#include "master/behaviour/ambush.h"
#include "master/behaviour/company.h"
#include "master/behaviour/hours.h"
#include "master/behaviour/intention_generator.h"
#include "master/behaviour/patrol.h"
#include "master/behaviour/routines.h"

namespace aquarama::behaviour {

namespace {

// A new point every 15 s.
constexpr std::uint64_t kTicksToAPlace = std::uint64_t{15} * 60;
// Share of the half extent of the water in which points lie.
constexpr float kInsideHome = 0.75F;
// Spread about the best depth, as a share of the half height.
constexpr float kDepthSpread = 0.4F;
constexpr float kAboveRockMetres = 0.45F;
// Homes over boulders lie within this share of the half extent of the water.
constexpr float kHomeInside = 0.8F;
// From the middle of a site outwards.
constexpr float kOffSiteMetres = 0.1F;

// Cosine and sine of 40 degrees: a predator makes for a point that far ahead on its oval.
constexpr float kBeatCosine = 0.766F;
constexpr float kBeatSine = 0.643F;
// Period in which some predators pass through the bait ball.
constexpr std::uint64_t kTicksOfPass = std::uint64_t{16} * 60;

// A point drawn from the cube -1 to 1.
glm::vec3 shareOf(std::uint32_t hash) {
    return {signedUnitOf(hash), signedUnitOf(hashOf(hash, 1)), signedUnitOf(hashOf(hash, 2))};
}

// Height y about the best depth, `share` -1 to 1, within the water.
float heightIn(const place::Region& water, float bestDepthMetres, float share) {
    const float half = kInsideHome * water.halfExtent.y;
    const float height = -bestDepthMetres + share * kDepthSpread * water.halfExtent.y;
    return std::clamp(height, water.centre.y - half, water.centre.y + half);
}

// Boulders that are within the water in plan.
std::vector<place::Rock> bouldersIn(const place::Obstacles& obstacles) {
    std::vector<place::Rock> boulders;
    for (const place::Rock& rock : obstacles.rocks) {
        const glm::vec3 from = rock.centre - obstacles.water.centre;
        if (std::abs(from.x) < kHomeInside * obstacles.water.halfExtent.x &&
            std::abs(from.z) < kHomeInside * obstacles.water.halfExtent.z)
            boulders.push_back(rock);
    }
    return boulders;
}

std::vector<place::Site> sitesOf(const surroundings::Surroundings& surroundings,
                                 const std::optional<config::SiteKind>& kind) {
    std::vector<place::Site> sites;
    for (const place::Site& site : surroundings.sites)
        if (kind && site.kind == *kind) sites.push_back(site);
    return sites;
}

// The element whose place is nearest in plan to what is wanted. `placeOf` gives it.
template <class Element, class PlaceOf>
const Element& nearestTo(glm::vec2 xz, const std::vector<Element>& all, const PlaceOf& placeOf) {
    return *std::ranges::min_element(all, {}, [&](const Element& one) {
        const glm::vec3 place = placeOf(one);
        return (place.x - xz.x) * (place.x - xz.x) + (place.z - xz.y) * (place.z - xz.y);
    });
}

// A place over a boulder, within the heights of the water.
glm::vec3 over(const place::Region& water, const place::Rock& rock) {
    const float lowest = water.centre.y - kHomeInside * water.halfExtent.y;
    const float highest = water.centre.y + kHomeInside * water.halfExtent.y;
    const float above = rock.centre.y + rock.radiusMetres + kAboveRockMetres;
    return {rock.centre.x, std::clamp(above, lowest, highest), rock.centre.z};
}

// In every third period a predator passes through the school, each at another time.
bool passes(const Environment& environment, std::uint32_t fish) {
    return (environment.tick.value / kTicksOfPass + fish) % 3 == 0;
}

// Through the middle of the ball and straight on until it is out on the other side.
glm::vec3 passGoal(const Environment& environment, glm::vec3 position, glm::vec3 course) {
    const glm::vec3 ball = environment.goal.position;
    const glm::vec3 towards = ball - position;
    const bool through = place::lengthOf(towards) < 2 * environment.schoolRadiusMetres &&
                         place::dot(towards, course) < 0;
    return through ? position + course * (2 * environment.schoolRadiusMetres) : ball;
}

// A pace lasts 5 s; a turn may begin it and lasts 1 s.
constexpr std::uint64_t kTicksOfPace = std::uint64_t{5} * 60;
constexpr std::uint64_t kTicksOfTurn = 60;
// Share of paces that begin with a random turn.
constexpr float kTurns = 0.35F;
// Share of the slow gait at which a fish hovers.
constexpr float kHoverPace = 0.15F;

// Weights against the unit vector of the present course.
constexpr float kHomeKeepCourse = 1.0F;
constexpr float kGo = 0.7F;
// Added to kGo when the fish is at its leash.
constexpr float kGoHome = 2.0F;
constexpr float kTurn = 1.5F;

// The random number of a pace, and the ticks since it began.
struct Spell {
    std::uint32_t hash;
    std::uint64_t ticks;
};
Spell spellOf(std::uint32_t seed, std::uint32_t fish, Tick tick) {
    const std::uint32_t own = hashOf(seed, Stream::Pace, fish);
    const std::uint64_t now = tick.value + own % kTicksOfPace;
    return {hashOf(own, static_cast<std::uint32_t>(now / kTicksOfPace)), now % kTicksOfPace};
}

// A random turn: 40 degrees if gradual, 100 if sharp, to either side. Zero where there is none now.
glm::vec3 turnOf(const fish::SpeciesParameters& parameters, const Spell& spell, glm::vec3 course) {
    const std::uint32_t hash = hashOf(spell.hash, Stream::WanderTurn);
    if (spell.ticks >= kTicksOfTurn || unitOf(hash) >= kTurns) return {};
    const bool gradual = unitOf(hashOf(spell.hash, Stream::TurnSharpness)) <
                         static_cast<float>(parameters.habits.gradualShare);
    const float cosine = gradual ? 0.766F : -0.174F;
    const float sine = (gradual ? 0.643F : 0.985F) * ((hash & 1U) != 0 ? 1.0F : -1.0F);
    return {course.x * cosine - course.z * sine, 0, course.x * sine + course.z * cosine};
}

// Where the homes of a species may be: at sites, else over boulders, else anywhere in the water.
struct HomePlaces {
    const place::Region& water;
    // Wanted places in plan, by group; empty where they are drawn.
    std::span<const glm::vec2> wanted;
    std::vector<place::Site> sites;
    std::vector<place::Rock> boulders;
    float bestDepthMetres = 0;

    [[nodiscard]] const place::Site& siteFor(std::uint32_t group) const {
        return wanted.empty() ? sites[group % sites.size()]
                              : nearestTo(wanted[group], sites, [](const place::Site& one) {
                                    return one.place;
                                });
    }

    [[nodiscard]] const place::Rock& boulderFor(std::uint32_t group, std::uint32_t drawn) const {
        return wanted.empty() ? boulders[drawn % boulders.size()]
                              : nearestTo(wanted[group], boulders, [](const place::Rock& one) {
                                    return one.centre;
                                });
    }

    [[nodiscard]] glm::vec3 inTheWater(std::uint32_t group,
                                       std::uint32_t drawn,
                                       std::uint32_t firstOfKind) const {
        glm::vec3 place = wanderingGoal(drawn, water, bestDepthMetres, firstOfKind + group, {});
        if (!wanted.empty()) place.x = wanted[group].x, place.z = wanted[group].y;
        return place;
    }

    // The home of a group of fish; `drawn`: its random number.
    [[nodiscard]] glm::vec3 homeFor(std::uint32_t group,
                                    std::uint32_t drawn,
                                    std::uint32_t firstOfKind) const {
        if (!sites.empty()) {
            const place::Site& site = siteFor(group);
            return site.place + site.normal * kOffSiteMetres;
        }
        if (!boulders.empty()) return over(water, boulderFor(group, drawn));
        return inTheWater(group, drawn, firstOfKind);
    }
};

}  // namespace

glm::vec3 wanderingGoal(std::uint32_t seed,
                        const place::Region& water,
                        float bestDepthMetres,
                        std::size_t fish,
                        Tick tick) {
    const std::uint32_t own = hashOf(seed, Stream::HomePlaces, static_cast<std::uint32_t>(fish));
    const std::uint64_t place = (tick.value + own % kTicksToAPlace) / kTicksToAPlace;
    const glm::vec3 share = shareOf(hashOf(own, static_cast<std::uint32_t>(place)));
    const glm::vec3 goal = water.centre + water.halfExtent * share * kInsideHome;
    return {goal.x, heightIn(water, bestDepthMetres, share.y), goal.z};
}

Homes homesOf(const surroundings::Surroundings& surroundings,
              const config::Habits& habits,
              std::span<const glm::vec2> wanted,
              std::uint32_t firstOfKind,
              std::uint32_t fish) {
    const config::Home& home = habits.home;
    if (home.kind != config::HomeKind::Place || fish == 0) return {};
    const auto count = static_cast<std::uint32_t>(wanted.size());
    Homes homes{.places = {}, .fishAtEach = count > 0 ? (fish + count - 1) / count : home.group};
    const place::Obstacles& obstacles = surroundings.obstacles;
    const HomePlaces places{
        .water = obstacles.water,
        .wanted = wanted,
        .sites = sitesOf(surroundings, home.site),
        .boulders = home.onTheReef ? bouldersIn(obstacles) : std::vector<place::Rock>{},
        .bestDepthMetres = static_cast<float>(habits.comfort.bestDepthMetres)};
    const std::uint32_t groups = (fish + homes.fishAtEach - 1) / homes.fishAtEach;
    for (std::uint32_t group = 0; group < groups; ++group) {
        const std::uint32_t own = hashOf(surroundings.seed, Stream::Homes, firstOfKind + group);
        homes.places.push_back(places.homeFor(group, own, firstOfKind));
    }
    return homes;
}

glm::vec3 homeOf(const fish::SpeciesParameters& parameters, std::uint32_t fish) {
    assert(fish >= parameters.first);
    assert(fish < parameters.last);
    return parameters.homes[(fish - parameters.first) / parameters.fishAtAHome];
}

glm::vec3 beatGoal(const Environment& environment,
                   const fish::SpeciesParameters& parameters,
                   std::uint32_t fish,
                   glm::vec3 position) {
    if (passes(environment, fish))
        return passGoal(environment, position, environment.view->heading(fish));
    const place::Region& water = environment.surroundings->obstacles.water;
    const std::uint32_t own = hashOf(environment.seed, Stream::Beats, fish);
    const float sine = (own & 1U) != 0 ? kBeatSine : -kBeatSine;
    const glm::vec3 from = (position - water.centre) / water.halfExtent;
    const glm::vec3 at = place::directionOf({from.x, 0, from.z}, {1, 0, 0});
    const glm::vec3 ahead{at.x * kBeatCosine - at.z * sine, 0, at.x * sine + at.z * kBeatCosine};
    const float deeper = place::valueAt(kPatrolsDeeper, environment.surroundings->timeOfDay);
    const glm::vec3 wandered =
        wanderingGoal(environment.seed,
                      water,
                      static_cast<float>(parameters.habits.comfort.bestDepthMetres) + deeper,
                      fish,
                      environment.tick);
    const glm::vec3 goal = water.centre + ahead * (kInsideHome * water.halfExtent);
    return {goal.x, wandered.y, goal.z};
}

Bound boundFor(const Environment& environment,
               const fish::SpeciesParameters& parameters,
               std::uint32_t fish,
               glm::vec3 position) {
    const config::Home& home = parameters.habits.home;
    const place::Obstacles& obstacles = environment.surroundings->obstacles;
    const auto depth = static_cast<float>(parameters.habits.comfort.bestDepthMetres);
    if (parameters.habits.role == config::Role::Predator && home.kind == config::HomeKind::None)
        return {(environment.gathering == config::Gathering::Mill
                     ? beatGoal(environment, parameters, fish, position)
                     : patrolGoal(environment, fish, position)) -
                    position,
                0};
    const glm::vec3 goal =
        wanderingGoal(environment.seed, obstacles.water, depth, fish, environment.tick);
    if (home.kind == config::HomeKind::None) return {goal - position, 0};
    const bool own = home.kind == config::HomeKind::Place;
    const glm::vec3 middle = own ? homeOf(parameters, fish) : environment.goal.position;
    const float radius =
        own ? static_cast<float>(home.radiusMetres) : environment.schoolRadiusMetres;
    const float leash = own ? static_cast<float>(home.leashMetres) : 2 * radius;
    // The point in all the water, scaled to the range of the home.
    const glm::vec3 share =
        (goal - obstacles.water.centre) / (obstacles.water.halfExtent * kInsideHome);
    const float away = place::lengthOf(position - middle);
    const float strayed = std::clamp((away - radius) / std::max(leash - radius, 0.01F), 0.0F, 1.0F);
    return {middle + share * (0.6F * radius) - position, strayed};
}

float paceOf(const fish::SpeciesParameters& parameters,
             std::uint32_t seed,
             std::uint32_t fish,
             Tick tick) {
    const config::Paces& paces = parameters.habits.paces;
    const float drawn = unitOf(hashOf(spellOf(seed, fish, tick).hash));
    const auto hover = static_cast<float>(paces.hover);
    const float slow = hover + static_cast<float>(paces.slow);
    const float medium = slow + static_cast<float>(paces.medium);
    if (drawn < hover) return kHoverPace * parameters.slow;
    if (drawn < slow) return parameters.slow;
    return drawn < medium ? parameters.medium : parameters.fast;
}

fish::Course wander(const Situation& situation) {
    const Environment& environment = situation.environment;
    const fish::SpeciesParameters& parameters = situation.parameters;
    const Senses& senses = situation.senses;
    if (const auto course = keptCompany(situation)) return *course;
    if (const auto course = lieInWait(situation)) return *course;
    const Bound bound = boundFor(environment, parameters, situation.fish, senses.position);
    const Spell spell = spellOf(environment.seed, situation.fish, environment.tick);
    const float calm = std::max(0.0F, 1 - senses.urgency);
    const glm::vec3 desired =
        senses.heading * kHomeKeepCourse +
        place::directionOf(bound.towards, senses.heading) *
            ((kGo + kGoHome * bound.strayed) * calm) +
        turnOf(parameters, spell, senses.heading) * (kTurn * calm * (1 - bound.strayed)) +
        roomFrom(situation);
    const float pace = paceOf(parameters, environment.seed, situation.fish, environment.tick);
    // Far from home a fish does not hover.
    return heading(situation, desired, std::max(pace, parameters.slow * bound.strayed));
}

}  // namespace aquarama::behaviour
