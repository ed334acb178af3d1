// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/home.h"

#include <algorithm>
#include <cassert>

#include "common/base/random_streams.h"
#include "common/place/place.h"
#include "master/behaviour/company.h"
#include "master/behaviour/intention_generator.h"
#include "master/behaviour/routines.h"

namespace aquarama::behaviour {

namespace {

// A new point every 15 s.
constexpr std::uint64_t kTicksToAPlace = std::uint64_t{15} * 60;
// Share of the half extent of the water in which points lie.
constexpr float kInside = 0.75F;
// Spread about the best depth, as a share of the half height.
constexpr float kDepthSpread = 0.4F;
constexpr float kAboveRockMetres = 0.45F;
// Homes lie within this share of the half height of the water.
constexpr float kHomeInside = 0.6F;

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
    const float half = kInside * water.halfExtent.y;
    const float height = -bestDepthMetres + share * kDepthSpread * water.halfExtent.y;
    return std::clamp(height, water.centre.y - half, water.centre.y + half);
}

bool standsIn(const place::Region& water, const place::Rock& rock) {
    return std::abs(rock.centre.x - water.centre.x) < kInside * water.halfExtent.x &&
           std::abs(rock.centre.z - water.centre.z) < kInside * water.halfExtent.z;
}

// The rock of a household, drawn among those within the water; null where there is none.
const place::Rock* rockFor(const surroundings::Obstacles& obstacles, std::uint32_t hash) {
    const auto isIn = [&](const place::Rock& rock) { return standsIn(obstacles.water, rock); };
    const auto count = std::ranges::count_if(obstacles.rocks, isIn);
    if (count == 0) return nullptr;
    auto left = static_cast<std::ptrdiff_t>(hash % static_cast<std::uint32_t>(count));
    for (const place::Rock& rock : obstacles.rocks)
        if (isIn(rock) && left-- == 0) return &rock;
    return nullptr;
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
constexpr float kKeepCourse = 1.0F;
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
    const std::uint32_t own = hashOf(hashOf(seed, Stream::Pace), fish);
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

}  // namespace

glm::vec3 wanderingGoal(std::uint32_t seed,
                        const place::Region& water,
                        float bestDepthMetres,
                        std::size_t fish,
                        Tick tick) {
    const std::uint32_t own =
        hashOf(hashOf(seed, Stream::HomePlaces), static_cast<std::uint32_t>(fish));
    const std::uint64_t place = (tick.value + own % kTicksToAPlace) / kTicksToAPlace;
    const glm::vec3 share = shareOf(hashOf(own, static_cast<std::uint32_t>(place)));
    const glm::vec3 goal = water.centre + water.halfExtent * share * kInside;
    return {goal.x, heightIn(water, bestDepthMetres, share.y), goal.z};
}

std::uint32_t householdOf(std::uint32_t firstOfKind, std::uint32_t fish) {
    assert(fish >= firstOfKind);
    return firstOfKind + (fish - firstOfKind) / 2;
}

glm::vec3 homeOf(std::uint32_t seed,
                 const config::Home& home,
                 const surroundings::Obstacles& obstacles,
                 float bestDepthMetres,
                 std::uint32_t household) {
    const place::Region& water = obstacles.water;
    const std::uint32_t hash = hashOf(hashOf(seed, Stream::Homes), household);
    const place::Rock* rock = home.onTheReef ? rockFor(obstacles, hash) : nullptr;
    if (rock == nullptr) return wanderingGoal(hash, water, bestDepthMetres, household, {});
    const float lowest = water.centre.y - kHomeInside * water.halfExtent.y;
    const float above = rock->centre.y + rock->radiusMetres + kAboveRockMetres;
    const float highest = water.centre.y + kHomeInside * water.halfExtent.y;
    return {rock->centre.x, std::clamp(above, lowest, highest), rock->centre.z};
}

glm::vec3 beatGoal(const Environment& environment,
                   const fish::SpeciesParameters& parameters,
                   std::uint32_t fish,
                   glm::vec3 position) {
    if (environment.gathering == config::Gathering::Mill && passes(environment, fish))
        return passGoal(environment, position, environment.view->heading(fish));
    const place::Region& water = environment.surroundings->obstacles.water;
    const std::uint32_t own = hashOf(hashOf(environment.seed, Stream::Beats), fish);
    const float sine = (own & 1U) != 0 ? kBeatSine : -kBeatSine;
    const glm::vec3 from = (position - water.centre) / water.halfExtent;
    const glm::vec3 at = place::directionOf({from.x, 0, from.z}, {1, 0, 0});
    const glm::vec3 ahead{at.x * kBeatCosine - at.z * sine, 0, at.x * sine + at.z * kBeatCosine};
    const glm::vec3 wandered = wanderingGoal(environment.seed,
                                             water,
                                             static_cast<float>(parameters.habits.bestDepthMetres),
                                             fish,
                                             environment.tick);
    const glm::vec3 goal = water.centre + ahead * (kInside * water.halfExtent);
    return {goal.x, wandered.y, goal.z};
}

Bound boundFor(const Environment& environment,
               const fish::SpeciesParameters& parameters,
               std::uint32_t fish,
               glm::vec3 position) {
    const config::Home& home = parameters.habits.home;
    const surroundings::Obstacles& obstacles = environment.surroundings->obstacles;
    const auto depth = static_cast<float>(parameters.habits.bestDepthMetres);
    if (parameters.habits.role == config::Role::Predator && home.kind == config::HomeKind::None)
        return {beatGoal(environment, parameters, fish, position) - position, 0};
    const glm::vec3 goal =
        wanderingGoal(environment.seed, obstacles.water, depth, fish, environment.tick);
    if (home.kind == config::HomeKind::None) return {goal - position, 0};
    const bool own = home.kind == config::HomeKind::Place;
    const glm::vec3 middle =
        own ? homeOf(environment.seed, home, obstacles, depth, householdOf(parameters.first, fish))
            : environment.goal.position;
    const float radius =
        own ? static_cast<float>(home.radiusMetres) : environment.schoolRadiusMetres;
    const float leash = own ? static_cast<float>(home.leashMetres) : 2 * radius;
    // The point in all the water, scaled to the range of the home.
    const glm::vec3 share =
        (goal - obstacles.water.centre) / (obstacles.water.halfExtent * kInside);
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
    const Bound bound = boundFor(environment, parameters, situation.fish, senses.position);
    const Spell spell = spellOf(environment.seed, situation.fish, environment.tick);
    const float calm = std::max(0.0F, 1 - senses.urgency);
    const glm::vec3 desired =
        senses.heading * kKeepCourse +
        place::directionOf(bound.towards, senses.heading) *
            ((kGo + kGoHome * bound.strayed) * calm) +
        turnOf(parameters, spell, senses.heading) * (kTurn * calm * (1 - bound.strayed)) +
        roomFrom(situation);
    const float pace = paceOf(parameters, environment.seed, situation.fish, environment.tick);
    // Far from home a fish does not hover.
    return heading(situation, desired, std::max(pace, parameters.slow * bound.strayed));
}

}  // namespace aquarama::behaviour
