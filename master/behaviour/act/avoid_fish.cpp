// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "common/place/angle.h"
#include "master/behaviour/act/company.h"
#include "master/behaviour/act/pursue.h"
#include "master/behaviour/act/routines.h"

namespace aquarama::behaviour {

namespace {

constexpr float kLookAheadSeconds = 2.0F;
constexpr float kAhead = 0.7F;     // cosine of 45 degrees: the threat is before the fish
constexpr float kSameWay = 0.5F;   // cosine of 60 degrees between two courses
constexpr float kTurnAway = 1.6F;  // against the unit vector of the own course
constexpr float kLean = 0.25F;
constexpr float kBrake = 0.25F;            // of slow, behind a tail
constexpr float kSureMissLengths = 0.05F;  // a smaller miss says nothing of a side

glm::vec3 rightOf(glm::vec3 heading) {
    return place::directionOf({-heading.z, 0, heading.x}, {0, 0, 1});
}

// From the fish to where the other will be when they are nearest.
glm::vec3 missOf(glm::vec3 offset, glm::vec3 approach) {
    const float squared = place::dot(approach, approach);
    if (squared < 1.0e-6F) return offset;
    const float soonest = -place::dot(offset, approach) / squared;
    return offset + approach * std::clamp(soonest, 0.0F, kLookAheadSeconds);
}

// Away from where the other passes. Of two that would meet nose to nose each turns to its right.
glm::vec3 asideFrom(glm::vec3 miss, glm::vec3 heading, float length) {
    const glm::vec3 across = miss - heading * place::dot(miss, heading);
    if (place::lengthOf(across) < kSureMissLengths * length) return rightOf(heading);
    return -place::directionOf(across, rightOf(heading));
}

// In its school a fish is as near to others as to none else: it only leans away, and keeps its
// place.
fish::Course leanAway(const Situation& situation, glm::vec3 aside) {
    fish::Course course = school(situation);
    course.direction =
        place::levelled(place::directionOf(course.direction + aside * kLean, course.direction));
    return course;
}

// Behind a tail it slows; one that comes from behind or beside it does not let slow it.
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

}  // namespace aquarama::behaviour
