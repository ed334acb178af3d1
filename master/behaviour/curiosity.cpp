// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/curiosity.h"

#include <algorithm>

#include "common/base/random_streams.h"
#include "common/place/place.h"
#include "master/behaviour/company.h"
#include "master/behaviour/intention_generator.h"
#include "master/surroundings/avoidance.h"

namespace aquarama::behaviour {

namespace {

// A hand frightens along the line from the viewer through it, within a cone about that line: radius
// at the viewer, and by how much it widens a metre.
constexpr float kConeMetres = 0.5F;
constexpr float kConeWidens = 0.16F;
constexpr float kConeBegins = 0.5F;
// How much the present heading counts in the choice of a side, in radii of the cone.
constexpr float kByHeading = 0.25F;
// A hand that holds still draws fish from so far, the boldest; they stay this near to it.
constexpr float kDrawsMetres = 4.5F;
constexpr float kGatherMetres = 0.45F;
// The least share of that distance, and of the pull, that the shyest have.
constexpr float kShyest = 0.4F;
// Weights against the unit vector of the course.
constexpr float kFlinch = 3.0F;
constexpr float kCome = 2.5F;
// From this fright on a fish makes a fast start.
constexpr float kStartles = 0.5F;
// Weaker pulls change nothing.
constexpr float kNoticed = 0.08F;

// What one quick hand adds: to the side on which the fish is, and where it is on none, to which it
// heads; less up or down, as no fish climbs steeply.
glm::vec3 flinchFrom(const surroundings::HeldHand& hand, glm::vec3 position, glm::vec3 heading) {
    const glm::vec3 from = position - hand.eye;
    const float along = place::dot(from, hand.direction);
    if (hand.quick <= 0 || along < kConeBegins) return {};
    const glm::vec3 aside = from - hand.direction * along;
    const float cone = kConeMetres + kConeWidens * along;
    const float near = 1 - place::lengthOf(aside) / cone;
    if (near <= 0) return {};
    const glm::vec3 right = place::directionOf({-hand.direction.z, 0, hand.direction.x}, {1, 0, 0});
    const float side = place::dot(aside, right) + kByHeading * cone * place::dot(heading, right);
    const glm::vec3 way = right * (side < 0 ? -1.0F : 1.0F) + glm::vec3(0, aside.y / cone, 0);
    return place::directionOf(way, right) * (hand.quick * std::min(1.0F, 2 * near));
}

bool isEasy(fish::Intention intention) {
    return intention == fish::Intention::Wander || intention == fish::Intention::School ||
           intention == fish::Intention::Hover;
}

// Whoever hunts is not curious, and is shy of nobody.
float boldnessOf(const Situation& situation) {
    const std::uint32_t drawn =
        hashOf(situation.environment.seed, Stream::Curiosity, situation.fish);
    return kShyest + (1 - kShyest) * 0.5F * (1 + signedUnitOf(drawn));
}

}  // namespace

HandSenses feelHands(const surroundings::HeldHands& held,
                     glm::vec3 position,
                     glm::vec3 heading,
                     float boldness) {
    HandSenses senses;
    glm::vec3 away{};
    for (const surroundings::HeldHand& hand : held.hands) {
        away += flinchFrom(hand, position, heading);
        const glm::vec3 to = hand.place - position;
        const float metres = place::lengthOf(to);
        const float draws = hand.still * boldness * (1 - metres / (kDrawsMetres * boldness));
        if (draws <= senses.curious) continue;
        senses.curious = draws;
        senses.metres = metres;
        senses.towards = place::directionOf(to, {});
    }
    senses.shy = std::min(1.0F, place::lengthOf(away));
    senses.away = place::directionOf(away, {});
    return senses;
}

glm::vec3 nearestHand(const surroundings::HeldHands& held, glm::vec3 position) {
    return std::ranges::min(held.hands,
                            {},
                            [&](const surroundings::HeldHand& hand) {
                                return place::lengthOf(hand.place - position);
                            })
        .place;
}

namespace {

// Out of the way of a quick hand, the nearer to it the faster; from half the fright on by a fast
// start.
fish::Course shyAway(const Situation& situation, const HandSenses& hands, float speed) {
    const fish::SpeciesParameters& parameters = situation.parameters;
    const float pace = parameters.slow + (parameters.fast - parameters.slow) * hands.shy;
    fish::Course course = heading(situation,
                                  situation.senses.heading + hands.away * (kFlinch * hands.shy),
                                  std::max(speed, pace));
    if (hands.shy < kStartles) return course;
    course.urgency = std::max(course.urgency, 1.0F);
    course.startsFast = hasRoom(
        situation, course.direction, kStartLengths, surroundings::berthOf(situation.senses.length));
    return course;
}

// To a hand that holds still, and about it.
fish::Course comeTo(const Situation& situation,
                    const HandSenses& hands,
                    const fish::Course& course) {
    const bool isThere = hands.metres < kGatherMetres;
    const glm::vec3 way = hands.towards * (isThere ? 0.0F : kCome);
    return heading(
        situation,
        course.direction + way + roomFrom(situation),
        isThere ? situation.parameters.slow : std::max(course.speed, situation.parameters.medium));
}

}  // namespace

fish::Course bentByHands(const Situation& situation,
                         const fish::Mind& mind,
                         const fish::Course& course) {
    const surroundings::HeldHands& held = situation.environment.surroundings->hands;
    const bool hunts = situation.parameters.habits.role == config::Role::Predator;
    if (held.hands.empty() || hunts) return course;
    const HandSenses hands =
        feelHands(held, situation.senses.position, situation.senses.heading, boldnessOf(situation));
    const bool isAtEase = isEasy(mind.intention);
    if (hands.shy > 0 && (isAtEase || mind.intention == fish::Intention::AvoidFish))
        return shyAway(situation, hands, course.speed);
    return isAtEase && hands.curious > kNoticed ? comeTo(situation, hands, course) : course;
}

}  // namespace aquarama::behaviour
