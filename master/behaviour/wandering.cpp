// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/wandering.h"

#include <algorithm>

#include "common/place/noise.h"
#include "master/behaviour/angle.h"
#include "master/behaviour/perception.h"

namespace aquarama {

namespace {

constexpr std::uint64_t kTicksToAPlace = 15 * 60;
constexpr std::uint32_t kPlaces = 301;  // stream of the seed

constexpr float kKeepCourse = 1.0F;  // weights against the unit vector of one's own course
constexpr float kGo = 0.7F;
constexpr float kGiveWay = 1.5F;
constexpr float kRoomBodyLengths = 1.2F;  // of the longer of two fish
constexpr float kReachSeconds = 2.0F;     // how far ahead the surroundings are felt
constexpr float kReachBodyLengths = 1.5F;
constexpr float kHurryBodyLengths = 8.0F;  // from so far away a fish goes a fifth faster

glm::vec3 awayFromOthers(const SchoolView& view, const Neighbours& neighbours, std::size_t fish) {
    glm::vec3 away{};
    for (std::size_t i = 0; i < neighbours.count; ++i) {
        const std::size_t other = neighbours.fish[i];
        const float room = kRoomBodyLengths * std::max(view.length[fish], view.length[other]);
        const glm::vec3 offset = view.position(other) - view.position(fish);
        const float tooNear = std::max(0.0F, 1 - lengthOf(offset) / room);
        away -= directionOf(offset, {0, 1, 0}) * tooNear;
    }
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

void Wandering::run(std::size_t first, std::size_t last) const {
    for (std::size_t fish = first; fish < last; ++fish)
        if (thinksAt(tick, fish)) think(fish);
}

void Wandering::think(std::size_t fish) const {
    const glm::vec3 position = view->position(fish);
    const glm::vec3 heading = view->heading(fish);
    const Neighbours neighbours = nearestVisible(*view, *grid, static_cast<std::uint32_t>(fish));
    const float reach = kReachBodyLengths * view->length[fish] + view->speed[fish] * kReachSeconds;
    const glm::vec3 push = avoidance(*surroundings, position, heading, reach);
    const float urgency = lengthOf(push);
    const glm::vec3 towards = wanderingGoal(seed, surroundings->water, fish, tick) - position;
    const glm::vec3 wish = heading * kKeepCourse +
                           directionOf(towards, heading) * (kGo * std::max(0.0F, 1 - urgency)) +
                           awayFromOthers(*view, neighbours, fish) * kGiveWay + push;
    const glm::vec3 direction = levelled(directionOf(wish, heading));
    intentions->directionX[fish] = direction.x;
    intentions->directionY[fish] = direction.y;
    intentions->directionZ[fish] = direction.z;
    intentions->urgency[fish] = urgency;
    const float far = lengthOf(towards) / view->length[fish] / kHurryBodyLengths;
    intentions->speed[fish] = cruise * (0.9F + 0.3F * std::min(1.0F, far));
}

}  // namespace aquarama
