// SPDX-License-Identifier: Apache-2.0
#include "master/world/release.h"

#include <algorithm>
#include <limits>

#include "common/place/place.h"
#include "master/behaviour/guided.h"

namespace aquarama::world {

namespace {

// So near to the place it has come: faster than a fish with a drawing, it does not turn so tightly.
constexpr float kThereMetres = 1.5F;
// One that has not come by then, in ticks, goes on as it was.
constexpr std::uint64_t kComes = 40 * 60;

// Room beside a rock, and what the way round one counts for.
constexpr float kBesideRockMetres = 0.6F;
constexpr float kRoundMetres = 8;
constexpr float kLeastSquaredMetres = 0.01F;

glm::vec3 placeOf(const FishColumns& columns, std::uint32_t fish) {
    return motion::bodyFrameOf(columns.states, fish).position;
}

// Forgets what it was about.
void callAway(fish::Mind& mind) {
    mind.intention = mind.remembered = fish::Intention::Wander;
    mind.target = mind.rememberedTarget = fish::kNobody;
    mind.stage = 0;
    mind.sinceStage = mind.pursued = 0;
}

void makeHungry(fish::Mind& mind) {
    mind.eaten = 0;
    mind.sinceChase = fish::kLongAgo;
}

// Whether a rock lies between two points, or beside their line.
bool isBlocked(const place::Obstacles& obstacles, glm::vec3 from, glm::vec3 to) {
    const glm::vec3 way = to - from;
    const float squared = std::max(place::dot(way, way), kLeastSquaredMetres);
    return std::ranges::any_of(obstacles.rocks, [&](const place::Rock& rock) {
        const float share = std::clamp(place::dot(rock.centre - from, way) / squared, 0.0F, 1.0F);
        return place::lengthOf(from + way * share - rock.centre) <
               rock.radiusMetres + kBesideRockMetres;
    });
}

// How far a hunter has to go, metres; round a rock it takes longer.
float wayOf(const place::Obstacles& obstacles, glm::vec3 from, glm::vec3 to) {
    return place::lengthOf(to - from) + (isBlocked(obstacles, from, to) ? kRoundMetres : 0.0F);
}

// Nobody where none can come.
std::uint32_t nearestOf(const fish::SpeciesParameters& species,
                        const place::Obstacles& obstacles,
                        const FishColumns& columns) {
    std::uint32_t nearest = fish::kNobody;
    float least = std::numeric_limits<float>::max();
    for (std::uint32_t fish = species.first; fish < species.last; ++fish) {
        if (motion::isAway(columns.states, fish) || columns.released.has(fish)) continue;
        const float way = wayOf(obstacles, placeOf(columns, fish), columns.released.place);
        if (way >= least) continue;
        least = way;
        nearest = fish;
    }
    return nearest;
}

}  // namespace

void release(const WaterAtTick& water, const ReleaseHunter& cue, FishColumns& columns) {
    if (cue.species >= water.speciesParameters.size()) return;
    const fish::SpeciesParameters& species = water.speciesParameters[cue.species];
    if (!fish::patrols(species)) return;
    columns.released.place =
        behaviour::hunterPlaceOf(columns.wearers, water.surroundings.obstacles);
    const std::uint32_t fish = nearestOf(species, water.surroundings.obstacles, columns);
    if (fish == fish::kNobody) return;
    callAway(columns.minds[fish]);
    columns.released.fish.push_back({fish, water.tick});
}

void leadReleased(const WaterAtTick& water, FishColumns& columns) {
    fish::ReleasedHunters& released = columns.released;
    if (released.fish.empty()) return;
    released.place = behaviour::hunterPlaceOf(columns.wearers, water.surroundings.obstacles);
    std::erase_if(released.fish, [&](const fish::Released& one) {
        fish::Mind& mind = columns.minds[one.fish];
        mind.sinceChase = 0;
        const glm::vec3 way = released.place - placeOf(columns, one.fish);
        const bool hasCome = place::lengthOf(way) < kThereMetres;
        if (hasCome) makeHungry(mind);
        return hasCome || water.tick.value - one.since.value > kComes;
    });
}

}  // namespace aquarama::world
