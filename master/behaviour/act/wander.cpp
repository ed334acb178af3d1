// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/act/wander.h"

#include <algorithm>

#include "common/place/angle.h"
#include "common/place/noise.h"
#include "master/behaviour/act/pursue.h"

namespace aquarama {

namespace {

constexpr std::uint64_t kTicksToAPlace = 15 * 60;
constexpr std::uint32_t kPlaces = 301;  // stream of the seed

constexpr float kKeepCourse = 1.0F;  // weights against the unit vector of one's own course
constexpr float kGo = 0.7F;
constexpr float kGiveWay = 1.5F;
constexpr float kRoomBodyLengths = 1.2F;   // of the longer of two fish
constexpr float kHurryBodyLengths = 8.0F;  // from so far away a fish goes a fifth faster

void giveWay(glm::vec3& away, const FishView& view, const Neighbours& those, std::uint32_t fish) {
    for (std::size_t i = 0; i < those.count; ++i) {
        const std::uint32_t other = those.fish[i];
        const float room = kRoomBodyLengths * std::max(view.length[fish], view.length[other]);
        const glm::vec3 offset = view.position(other) - view.position(fish);
        const float tooNear = std::max(0.0F, 1 - lengthOf(offset) / room);
        away -= directionOf(offset, {0, 1, 0}) * tooNear;
    }
}

glm::vec3 awayFromOthers(const FishView& view, const Senses& senses, std::uint32_t fish) {
    glm::vec3 away{};
    giveWay(away, view, senses.schoolmates, fish);
    giveWay(away, view, senses.others, fish);
    return away;
}

}  // namespace

glm::vec3 wanderingGoal(std::uint32_t seed, const Region& water, std::size_t fish, Tick tick) {
    const std::uint32_t own = hashOf(hashOf(seed, kPlaces), static_cast<std::uint32_t>(fish));
    const std::uint64_t place = (tick.value + own % kTicksToAPlace) / kTicksToAPlace;
    const std::uint32_t hash = hashOf(own, static_cast<std::uint32_t>(place));
    const glm::vec3 share{
        signedUnitOf(hash), signedUnitOf(hashOf(hash, 1)), signedUnitOf(hashOf(hash, 2))};
    return water.centre + water.halfExtent * share * 0.75F;
}

Course wander(const Situation& situation) {
    const Environment& environment = situation.environment;
    const Senses& senses = situation.senses;
    const Region& water = environment.surroundings->obstacles.water;
    const glm::vec3 towards =
        wanderingGoal(environment.seed, water, situation.fish, environment.tick) - senses.position;
    const glm::vec3 wish =
        senses.heading * kKeepCourse +
        directionOf(towards, senses.heading) * (kGo * std::max(0.0F, 1 - senses.urgency)) +
        awayFromOthers(*environment.view, senses, situation.fish) * kGiveWay;
    const float far = lengthOf(towards) / senses.length / kHurryBodyLengths;
    return heading(situation, wish, situation.nature.slow * (0.9F + 0.3F * std::min(1.0F, far)));
}

}  // namespace aquarama
