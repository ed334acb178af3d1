// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/guided.h"

#include <algorithm>
#include <array>

#include <glm/common.hpp>

#include "common/place/obstacles.h"
#include "common/place/place.h"
#include "master/behaviour/company.h"
#include "master/behaviour/intention_generator.h"

namespace aquarama::behaviour {

namespace {

// Of the entrance from the viewer: to a side and behind, so that no wall but a dome shows it.
constexpr float kAsideMetres = 2.4F;
constexpr float kBehindMetres = 1.2F;
// Of the place where it shows itself: ahead, and to its maker's side.
constexpr float kAheadMetres = 1.9F;
constexpr float kToMakerMetres = 0.8F;
// Of the place to which a hunter comes, ahead.
constexpr float kHunterAheadMetres = 2.6F;
// So near it is there.
constexpr float kThereMetres = 0.8F;
// Room about such places to sand, surface, rocks and the border of the water.
constexpr float kRoomMetres = 0.4F;
constexpr float kShore = 0.95F;  // share of the water's half extent
constexpr int kSteps = 6;
// Weight of the way against the push of neighbours.
constexpr float kLed = 3.0F;

// Whose maker stands in the middle comes from either side.
float sideOf(const fish::Wearer& wearer) {
    if (wearer.aside != 0) return static_cast<float>(wearer.aside);
    return wearer.number % 2 == 0 ? -1.0F : 1.0F;
}

bool isFree(const place::Obstacles& obstacles, glm::vec3 place) {
    return std::ranges::none_of(obstacles.rocks, [&](const place::Rock& rock) {
        return place::lengthOf(place - rock.centre) < rock.radiusMetres + kRoomMetres;
    });
}

// Within the border of the water, over the sand and under the surface.
glm::vec3 withinWater(const place::Obstacles& obstacles, glm::vec3 place) {
    const glm::vec3 reach = obstacles.water.halfExtent * kShore;
    place = glm::clamp(place, obstacles.water.centre - reach, obstacles.water.centre + reach);
    const float floor = place::floorHeight(obstacles.place, {place.x, place.z});
    place.y = std::min(std::max(place.y, floor + kRoomMetres), -kRoomMetres);
    return place;
}

// The place itself, or one near it that is clear of rocks: first beside it, then farther off.
glm::vec3 inWater(const place::Obstacles& obstacles, glm::vec3 place) {
    static constexpr std::array<glm::vec3, 5> kWays{
        glm::vec3{0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}};
    const glm::vec3 wanted = withinWater(obstacles, place);
    if (isFree(obstacles, wanted)) return wanted;
    for (int step = 1; step <= kSteps; ++step)
        for (const glm::vec3 way : kWays) {
            const glm::vec3 near =
                withinWater(obstacles, wanted + way * (kRoomMetres * static_cast<float>(step)));
            if (isFree(obstacles, near)) return near;
        }
    return wanted;
}

bool isLed(fish::Intention intention) {
    return intention != fish::Intention::Escape && intention != fish::Intention::AvoidFish &&
           intention != fish::Intention::AvoidObstacle;
}

}  // namespace

glm::vec3 entranceOf(const fish::Wearers& wearers,
                     const fish::Wearer& wearer,
                     const place::Obstacles& obstacles) {
    return inWater(obstacles,
                   wearers.eye + wearers.right * (kAsideMetres * sideOf(wearer)) -
                       wearers.ahead * kBehindMetres);
}

glm::vec3 greetingPlaceOf(const fish::Wearers& wearers,
                          const fish::Wearer& wearer,
                          const place::Obstacles& obstacles) {
    return inWater(obstacles,
                   wearers.eye + wearers.ahead * kAheadMetres +
                       wearers.right * (kToMakerMetres * static_cast<float>(wearer.aside)));
}

glm::vec3 hunterPlaceOf(const fish::Wearers& wearers, const place::Obstacles& obstacles) {
    return inWater(obstacles, wearers.eye + wearers.ahead * kHunterAheadMetres);
}

bool isAt(glm::vec3 position, glm::vec3 place) {
    return place::lengthOf(place - position) < kThereMetres;
}

namespace {

// Where it goes; where it shows itself it turns its side to the viewer.
glm::vec3 wayOf(const fish::Wearers& wearers,
                const fish::Wearer& wearer,
                const place::Obstacles& obstacles,
                glm::vec3 position,
                glm::vec3 otherwise) {
    const glm::vec3 goal = wearer.visit == fish::Visit::Leaves
                               ? entranceOf(wearers, wearer, obstacles)
                               : greetingPlaceOf(wearers, wearer, obstacles);
    if (wearer.visit == fish::Visit::Shows && isAt(position, goal))
        return wearers.right * -sideOf(wearer);
    return place::directionOf(goal - position, otherwise);
}

// Of a hunter that is on its way; it makes way for nobody.
fish::Course comingTo(const Situation& situation, glm::vec3 place) {
    const Senses& senses = situation.senses;
    const glm::vec3 way = place::directionOf(place - senses.position, senses.heading);
    return heading(situation, way * kLed + roomFrom(situation), situation.parameters.fast);
}

}  // namespace

fish::Course guided(const Situation& situation,
                    const fish::Mind& mind,
                    const fish::Course& course) {
    const fish::ReleasedHunters* const released = situation.environment.released;
    const bool isComing = released != nullptr && released->has(situation.fish) &&
                          mind.intention != fish::Intention::AvoidObstacle;
    if (isComing) return comingTo(situation, released->place);
    const fish::Wearers* const wearers = situation.environment.wearers;
    const fish::Wearer* const wearer = wearers == nullptr ? nullptr : wearers->of(situation.fish);
    if (wearer == nullptr || wearer->visit == fish::Visit::Stays || !isLed(mind.intention))
        return course;
    const fish::SpeciesParameters& parameters = situation.parameters;
    const place::Obstacles& obstacles = situation.environment.surroundings->obstacles;
    const glm::vec3 position = situation.senses.position;
    const glm::vec3 way = wayOf(*wearers, *wearer, obstacles, position, course.direction);
    const bool isThere = wearer->visit == fish::Visit::Shows &&
                         isAt(position, greetingPlaceOf(*wearers, *wearer, obstacles));
    return heading(
        situation, way * kLed + roomFrom(situation), isThere ? parameters.slow : parameters.fast);
}

}  // namespace aquarama::behaviour
