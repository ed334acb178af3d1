// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "common/place/angle.h"
#include "common/place/noise.h"
#include "common/units/random_streams.h"
#include "master/behaviour/act/company.h"
#include "master/behaviour/act/pursue.h"
#include "master/behaviour/act/routines.h"

namespace aquarama::behaviour {

namespace {

constexpr float kKeepCourse = 0.8F;  // weights against the unit vector of one's own course
constexpr float kFollow = 0.7F;
constexpr float kWander = 0.55F;
constexpr float kAttentive = 0.7F;  // so much less of that, alarmed
constexpr float kGiveWayToHunter = 0.8F;

constexpr float kSlowest = 0.85F;  // body lengths a second
constexpr float kFastest = 2.9F;
constexpr float kMillPace = 1.9F;
constexpr float kBaitBallPace = 2.1F;
constexpr float kBrakeBefore = 0.4F;  // body lengths a second, for a push of 1 straight back
constexpr float kAlarmedPace = 0.5F;  // more than at ease

constexpr std::uint32_t kGlimpses = 4;
constexpr std::uint64_t kTicksOfGlance = 60;
constexpr float kRejoin = 1.5F;
constexpr float kKeepLevel = 1.0F;  // against the way round the ball

// How far from the goal, in the shape of the school: a ball, flatter where the water is shallow.
glm::vec3 fromGoal(const surroundings::Goal& goal, glm::vec3 position) {
    glm::vec3 towards = goal.position - position;
    towards.y /= goal.flatness;
    return towards;
}

// Where the school as a whole goes: along with the goal, and towards it from outside the school.
glm::vec3 followed(const surroundings::Goal& goal, glm::vec3 towards, float pull) {
    return place::directionOf(towards, {}) * pull + goal.velocityMetresPerSecond * 2.0F;
}

// Round the goal.
glm::vec3 circled(const surroundings::Goal& goal, glm::vec3 towards, float pull) {
    const float turn = goal.mill > 0 ? 1.0F : -1.0F;
    const glm::vec3 around{-towards.z * turn, 0, towards.x * turn};
    return place::directionOf(around, {1, 0, 0}) * 1.6F +
           place::directionOf(towards, {}) * (pull + 0.3F);
}

glm::vec3 toLevel(const Environment& environment, std::uint32_t fish, glm::vec3 towards) {
    const float high = environment.schoolRadiusMetres;
    const float climb = towards.y + levelInBall(environment.seed, fish) * high;
    return {0, std::clamp(climb / (0.3F * high), -1.0F, 1.0F) * kKeepLevel, 0};
}

glm::vec3 commonWay(const Environment& environment, std::uint32_t fish, glm::vec3 position) {
    const surroundings::Goal& goal = environment.goal;
    const glm::vec3 towards = fromGoal(goal, position);
    const float outside = place::lengthOf(towards) - environment.schoolRadiusMetres;
    const float pull = std::clamp(outside / environment.schoolRadiusMetres, 0.0F, 1.5F);
    const glm::vec3 follow = followed(goal, towards, pull);
    if (environment.gathering == config::Gathering::Mill)
        return circled(goal, towards, pull) + toLevel(environment, fish, towards);
    if (goal.mill == 0) return follow;
    return follow + (circled(goal, towards, pull) - follow) * std::abs(goal.mill);
}

// A slow whim of each fish, so that no two hold quite the same course.
glm::vec3 whim(std::uint32_t seed, std::size_t fish, Tick tick) {
    const std::uint32_t own = hashOf(seed, static_cast<std::uint32_t>(fish));
    const float seconds = static_cast<float>(tick.value % (1U << 20U)) / 60.0F;
    return {place::valueNoise(own, {seconds * 0.5F, 0.5F}),
            0.6F * place::valueNoise(own, {seconds * 0.5F, 8.5F}),
            place::valueNoise(own, {seconds * 0.5F, 16.5F})};
}

// The pace of the goal and of those about, quicker where the school is ahead and slower behind
// others' tails.
float wantedSpeed(const Situation& situation, const Company& company, float alarm) {
    const surroundings::Goal& goal = situation.environment.goal;
    const Senses& senses = situation.senses;
    float own = situation.parameters.medium;
    if (situation.environment.gathering != config::Gathering::None) {
        const float perLength = 1 / senses.length;
        const float behind =
            place::dot(goal.position - senses.position, senses.heading) * perLength;
        const float goalPace =
            place::lengthOf(goal.velocityMetresPerSecond) * perLength + 0.12F * behind;
        const bool ball = situation.environment.gathering == config::Gathering::Mill;
        const float round = ball ? kBaitBallPace : kMillPace;
        own = goalPace + (round - goalPace) * std::abs(goal.mill);
    }
    const float pace = company.speed > 0 ? 0.5F * (own + company.speed) : own;
    // What it heads for slows it too.
    const float stop = kBrakeBefore * std::max(0.0F, -place::dot(senses.push, senses.heading));
    return std::clamp(
        pace + company.hurry - company.brake - stop + kAlarmedPace * alarm, kSlowest, kFastest);
}

// Whom it catches sight of, of its own kind.
using Glance = std::array<std::uint32_t, kGlimpses>;
Glance glanceOf(const Situation& situation) {
    const fish::SpeciesParameters& parameters = situation.parameters;
    const std::uint32_t own =
        hashOf(hashOf(situation.environment.seed, Stream::Glances), situation.fish);
    const auto when = static_cast<std::uint32_t>(situation.environment.tick.value / kTicksOfGlance);
    Glance glance{};
    for (std::uint32_t i = 0; i < kGlimpses; ++i) {
        glance[i] =
            parameters.first + hashOf(hashOf(own, when), i) % (parameters.last - parameters.first);
        situation.environment.view->fetch(glance[i]);
    }
    return glance;
}

// Beyond its neighbours a fish sees others of its kind, a few at a time: so parts of a school that
// lost one another find together again; alarmed, all seek the middle.
glm::vec3 glimpses(const Situation& situation, const Glance& glance, float alarm) {
    const fish::FishView& view = *situation.environment.view;
    // A school is a large, flashing thing: it is seen as far as the water is clear.
    const float sight = situation.environment.surroundings->clarityMetres;
    glm::vec3 sum{};
    for (const std::uint32_t other : glance) {
        const glm::vec3 offset = view.position(other) - situation.senses.position;
        const float distance = place::lengthOf(offset);
        const bool seen = distance > kSightMetres * (1 - alarm) && distance < sight &&
                          !view.shows(other, fish::kAway) &&
                          inFieldOfView(situation.senses.heading, offset);
        if (seen) sum += offset / (distance * static_cast<float>(kGlimpses));
    }
    return sum;
}

// 0 up to the fear that is heeded, 1 from that on with which each flees for itself: a predator that
// only goes about far off does not press a school together.
float alarmOf(const fish::SpeciesParameters& parameters, const fish::Feelings& feelings) {
    const float more = feelings.fear - parameters.habits.fearFrom;
    return std::clamp(
        more / std::max(parameters.habits.fearAlone - parameters.habits.fearFrom, 0.01F),
        0.0F,
        1.0F);
}

// Schoolmates give way to a predator before it comes so near that each flees for itself.
glm::vec3 clearing(const Situation& situation) {
    const fish::SpeciesParameters& parameters = situation.parameters;
    const float fear = situation.feelings.greatestFear - parameters.habits.fearFrom;
    if (fear <= 0) return {};
    const float share = std::min(
        1.0F, fear / std::max(parameters.habits.fearAlone - parameters.habits.fearFrom, 0.01F));
    return flightFrom(situation) * (kGiveWayToHunter * share);
}

}  // namespace

float levelInBall(std::uint32_t seed, std::uint32_t fish) {
    const std::uint32_t own = hashOf(hashOf(seed, Stream::SchoolLevels), fish);
    return unitOf(own) + unitOf(hashOf(own)) - 1;
}

float schoolRadiusMetres(std::size_t fish) {
    // A ball at one fish in (0.3 m)^3; grown in steps, as there is no exact cube root.
    float radius = 0.3F;
    while (radius * radius * radius < static_cast<float>(fish) * 0.015F) radius *= 1.1F;
    return radius;
}

fish::Course school(const Situation& situation) {
    const Environment& environment = situation.environment;
    const Senses& senses = situation.senses;
    const float alarm = alarmOf(situation.parameters, situation.feelings);
    const bool gathers = environment.gathering != config::Gathering::None;
    const Glance glance = gathers ? Glance{} : glanceOf(situation);
    const Company company = companyOf(*environment.view, senses, situation.fish, alarm);
    // What must be avoided comes before where one would like to go.
    const float follow = kFollow * std::max(0.0F, 1 - senses.urgency);
    const glm::vec3 way = gathers ? commonWay(environment, situation.fish, senses.position)
                                  : glimpses(situation, glance, alarm) * kRejoin;
    const glm::vec3 desired = senses.heading * kKeepCourse + pullOf(company) + way * follow +
                              whim(environment.seed, situation.fish, environment.tick) *
                                  (kWander * (1 - kAttentive * alarm)) +
                              clearing(situation) + wayRound(situation);
    return {place::levelled(place::directionOf(desired, senses.heading)),
            wantedSpeed(situation, company, alarm),
            senses.urgency};
}

}  // namespace aquarama::behaviour
