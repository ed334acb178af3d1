// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "common/place/place.h"
#include "master/behaviour/company.h"
#include "master/behaviour/home.h"
#include "master/behaviour/intention_generator.h"
#include "master/behaviour/routines.h"
#include "master/surroundings/avoidance.h"

namespace aquarama::behaviour {

namespace {

// How far ahead the paths of two fish are extrapolated.
constexpr float kLookAheadSeconds = 2.0F;
// Cosine of 45 degrees: another fish within it is ahead.
constexpr float kAhead = 0.7F;
// Cosine of 60 degrees between two courses.
constexpr float kSameWay = 0.5F;
// Weights of going aside against the unit vector of the course: alone, and in a school.
constexpr float kTurnAway = 1.6F;
constexpr float kLean = 0.25F;
// Share by which it is slower than the fish ahead.
constexpr float kBrake = 0.25F;
// A miss in body lengths; a smaller one does not tell the side.
constexpr float kSureMissLengths = 0.05F;

// The level direction to the right of a heading.
glm::vec3 rightOf(glm::vec3 heading) {
    return place::directionOf({-heading.z, 0, heading.x}, {0, 0, 1});
}

// Offset to the other fish when both are nearest to each other, within the look-ahead. `approach`
// is its velocity relative to the fish.
glm::vec3 missOf(glm::vec3 offset, glm::vec3 approach) {
    const float squared = place::dot(approach, approach);
    if (squared < 1.0e-6F) return offset;
    const float soonest = -place::dot(offset, approach) / squared;
    return offset + approach * std::clamp(soonest, 0.0F, kLookAheadSeconds);
}

// Away from where the other passes. Two that would meet head-on both turn to their right.
glm::vec3 asideFrom(glm::vec3 miss, glm::vec3 heading, float length) {
    const glm::vec3 across = miss - heading * place::dot(miss, heading);
    if (place::lengthOf(across) < kSureMissLengths * length) return rightOf(heading);
    return -place::directionOf(across, rightOf(heading));
}

// In a school other fish are always near: it only leans away and keeps its place.
fish::Course leanAway(const Situation& situation, glm::vec3 aside) {
    fish::Course course = school(situation);
    course.direction =
        place::levelled(place::directionOf(course.direction + aside * kLean, course.direction));
    return course;
}

// Behind another fish it slows down; one from behind or beside does not slow it.
float speedPast(const Situation& situation) {
    const fish::FishView& view = *situation.environment.view;
    const Senses& senses = situation.senses;
    const Sighting& threat = senses.collision;
    const float slow = situation.parameters.slow;
    const bool ahead =
        place::dot(place::directionOf(threat.offset, senses.heading), senses.heading) > kAhead;
    const bool sameWay = place::dot(view.heading(threat.object), senses.heading) > kSameWay;
    if (!ahead) return std::max(slow, senses.speed / senses.length);
    const float theirs = view.fish[threat.object].speed / senses.length;
    return sameWay ? std::min(slow, theirs * (1 - kBrake)) : slow;
}

// About the tangent of 12 degrees: a push nearer to straight back says nothing about a side.
constexpr float kHeadOn = 0.2F;

// A push of this strength straight back makes the fish want to stop, a stronger one to back out.
constexpr float kStopsAt = 3.0F;

// Weight of the present course of a fish in the way of the submarine: it is out of the way sooner
// on it, and faster, than after a turn.
constexpr float kOnwards = 2.0F;

// Side to take where the push prefers none: towards the middle of the water.
float openSide(const Situation& situation, glm::vec3 right) {
    const glm::vec3 middle = situation.environment.surroundings->obstacles.water.centre;
    return place::dot(middle - situation.senses.position, right) < 0 ? -1.0F : 1.0F;
}

// Number of heights that are tried.
constexpr int kHeights = 16;
// Share of the half height of the water in which they lie.
constexpr float kInside = 0.85F;
// A degree too warm or too cold is as bad as a tenth of the light.
constexpr float kPerCelsius = 0.1F;
// Distance in height from which it climbs or dives fully.
constexpr float kSlantMetres = 2.0F;
// Decides between equally good heights for the nearer one.
constexpr float kTiePerMetre = 1.0e-3F;

// How far a value is outside a range; 0 inside.
float beyond(const config::Span& span, float value) {
    return std::max(
        {0.0F, static_cast<float>(span.least) - value, value - static_cast<float>(span.most)});
}

// How badly the water at a height suits the species; 0: well.
float illAt(const Situation& situation, float y) {
    const surroundings::Surroundings& around = *situation.environment.surroundings;
    const config::Habits& habits = situation.parameters.habits;
    return beyond(habits.comfort.light, surroundings::lightAt(around.climate, around.daylight, y)) +
           kPerCelsius *
               beyond(habits.comfort.waterCelsius, surroundings::celsiusAt(around.climate, y));
}

// Weight of flight against the unit vector of the present course.
constexpr float kFlee = 2.5F;
// Urgency from which the motor turns sharply.
constexpr float kSharpStart = 1.0F;

// How much flight outweighs the school: 0 when it has just left the school, 1 when the predator is
// so near that only flight counts.
float dread(const fish::SpeciesParameters& parameters, const fish::Feelings& feelings) {
    const float more = feelings.greatestFear - parameters.habits.fear.alone;
    return std::clamp(more / std::max(1 - parameters.habits.fear.alone, 0.01F), 0.0F, 1.0F);
}

// A fish is startled by a predator that would reach it within this time, and by a startled
// schoolmate within so many of its own body lengths: so alarm runs through a school faster than the
// predator.
constexpr float kLoomingSeconds = 0.9F;
constexpr float kAlarmBodyLengths = 2.0F;

// Whether a rushing predator comes so near so fast.
bool looms(const Situation& situation, const Sighting& predator) {
    const fish::FishView& view = *situation.environment.view;
    const bool rushes = predator.hunting &&
                        view.stage[predator.object] == static_cast<std::uint8_t>(HuntStage::Rush);
    if (!rushes) return false;
    const glm::vec3 theirs = view.heading(predator.object) * view.fish[predator.object].speed;
    const glm::vec3 own = situation.senses.heading * situation.senses.speed;
    const float approach = -place::dot(theirs - own, predator.offset) / predator.distance;
    const float toMouth =
        predator.distance - fish::kNoseBodyLengths * view.fish[predator.object].length;
    return approach * kLoomingSeconds > toMouth - situation.senses.length;
}

bool isStartled(const Situation& situation) {
    const Senses& senses = situation.senses;
    const auto predators = std::span(senses.predators).first(senses.predatorCount);
    if (std::ranges::any_of(predators, [&](const Sighting& one) { return looms(situation, one); }))
        return true;
    const float reach = kAlarmBodyLengths * senses.length;
    for (std::size_t i = 0; i < senses.schoolmates.count; ++i)
        if (senses.schoolmates.distanceSquared[i] < reach * reach &&
            situation.environment.view->shows(senses.schoolmates.fish[i], fish::kStartled))
            return true;
    return false;
}

}  // namespace

fish::Course avoidFish(const Situation& situation, const fish::Mind& mind) {
    const fish::FishView& view = *situation.environment.view;
    const Senses& senses = situation.senses;
    const Sighting& threat = senses.collision;
    if (!threat.seen()) return heading(situation, senses.heading, situation.parameters.slow);
    const glm::vec3 theirs = view.heading(threat.object) * view.fish[threat.object].speed;
    const glm::vec3 miss = missOf(threat.offset, theirs - senses.heading * senses.speed);
    const glm::vec3 aside = asideFrom(miss, senses.heading, senses.length);
    const bool schooling = situation.parameters.habits.role == config::Role::Prey &&
                           (mind.likes & fish::kLikesSchooling) != 0;
    if (schooling && view.kind[threat.object] == situation.parameters.kind)
        return leanAway(situation, aside);
    const glm::vec3 desired = senses.heading + aside * kTurnAway + roomFrom(situation);
    return heading(situation, desired, speedPast(situation));
}

glm::vec3 wayRound(const Situation& situation) {
    const Senses& senses = situation.senses;
    const float back = -place::dot(senses.push, senses.heading);
    if (back <= 0) return senses.push;
    const glm::vec3 right = place::directionOf({-senses.heading.z, 0, senses.heading.x}, {0, 0, 1});
    const float aside = place::dot(senses.push, right);
    const float up = senses.push.y + back * senses.heading.y;
    if (aside * aside + up * up > kHeadOn * kHeadOn * back * back) return senses.push;
    // To the side to which the push leans; where it leans to none, to the open side.
    const bool even = std::abs(aside) < 0.05F * back;
    const float side = even ? openSide(situation, right) : (aside < 0 ? -1.0F : 1.0F);
    return senses.push + right * (side * back);
}

fish::Course avoidObstacle(const Situation& situation, const fish::Mind& mind) {
    if ((mind.likes & fish::kLikesSchooling) != 0 &&
        situation.parameters.habits.role == config::Role::Prey)
        return school(situation);
    const Senses& senses = situation.senses;
    const float back = std::max(0.0F, -place::dot(senses.push, senses.heading));
    const fish::SpeciesParameters& parameters = situation.parameters;
    // A fish in the way of the submarine must not stop.
    const float pace = senses.hurry > 0
                           ? parameters.slow + (parameters.fast - parameters.slow) * senses.hurry
                           : parameters.slow * std::max(-1.0F, 1 - back / kStopsAt);
    const glm::vec3 onwards = senses.heading * (1 + kOnwards * senses.hurry);
    return heading(situation, onwards + roomFrom(situation), pace);
}

float suitableHeight(const Situation& situation) {
    const place::Region& water = situation.environment.surroundings->obstacles.water;
    const float own = situation.senses.position.y;
    float best = own;
    float least = illAt(situation, own);
    for (int i = 0; i <= kHeights; ++i) {
        const float share = 2 * static_cast<float>(i) / kHeights - 1;
        const float y = water.centre.y + share * kInside * water.halfExtent.y;
        const float ill = illAt(situation, y) + kTiePerMetre * std::abs(y - own);
        if (ill >= least) continue;
        least = ill;
        best = y;
    }
    return best;
}

fish::Course leave(const Situation& situation) {
    const Senses& senses = situation.senses;
    const float climb = suitableHeight(situation) - senses.position.y;
    const glm::vec3 about =
        boundFor(situation.environment, situation.parameters, situation.fish, senses.position)
            .towards;
    const glm::vec3 level = place::directionOf({about.x, 0, about.z}, senses.heading);
    const glm::vec3 desired = senses.heading * 0.5F + level * 0.5F +
                              glm::vec3{0, std::clamp(climb / kSlantMetres, -1.0F, 1.0F), 0};
    return heading(situation, desired, situation.parameters.medium);
}

fish::Course escape(const Situation& situation, const fish::Mind& mind) {
    const Senses& senses = situation.senses;
    const glm::vec3 desired = senses.heading + flightFrom(situation) * kFlee + roomFrom(situation);
    fish::Course course = heading(situation, desired, situation.parameters.fast);
    if ((mind.likes & fish::kLikesSchooling) != 0) {
        const float alone = dread(situation.parameters, situation.feelings);
        const glm::vec3 together = school(situation).direction;
        course.direction = place::levelled(
            place::directionOf(together + (course.direction - together) * alone, course.direction));
    }
    course.urgency = std::max(course.urgency, kSharpStart);
    course.startsFast =
        isStartled(situation) &&
        hasRoom(situation, course.direction, kStartLengths, surroundings::berthOf(senses.length));
    return course;
}

}  // namespace aquarama::behaviour
