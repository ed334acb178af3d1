// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/act/school.h"

#include <algorithm>

#include "common/place/angle.h"
#include "common/place/noise.h"

namespace aquarama {

namespace {

// Distances in body lengths. Huth & Wissel 1992 have zones (repulse 0.5, align 2, attract 5); here
// the zones fade into one another, so that the school settles at its spacing instead of dithering
// at a border.
constexpr float kSpacing = 0.9F;
constexpr float kAbreastToFile = 0.6F;  // room abreast for room in file
constexpr float kAsideShare = 0.25F;    // of a push in file that is along it: the rest is sideways
constexpr float kAlignFully = 2.0F;
constexpr float kAttractFully = 5.0F;

constexpr float kKeepCourse = 0.8F;  // weights against the unit vector of one's own course
constexpr float kSeparate = 2.2F;
constexpr float kMostSeparation = 0.9F;
constexpr float kAlign = 0.9F;
constexpr float kCohere = 1.2F;
constexpr float kFollow = 0.7F;
constexpr float kWander = 0.55F;

constexpr float kSlowest = 0.85F;  // body lengths a second
constexpr float kFastest = 2.9F;
constexpr float kMillPace = 1.9F;

struct Company {
    glm::vec3 separation{}, alignment{}, cohesion{};
    float speed = 0;  // mean of theirs, body lengths a second
    float hurry = 0;  // to close up, body lengths a second
    float brake = 0;  // for those just ahead, body lengths a second
};

struct Neighbour {
    glm::vec3 offset;  // in lengths: of the fish itself, or of a larger one that it meets
    glm::vec3 towards;
    float distance;
};

Neighbour neighbourOf(const FishView& view, const Senses& senses, std::uint32_t other, float per) {
    const glm::vec3 offset = (view.position(other) - senses.position) * per;
    return {offset, directionOf(offset, {0, 1, 0}), lengthOf(offset)};
}

// Fish are long: in file they need more room than abreast; there the one behind brakes and moves
// aside.
void giveWay(Company& company, const Neighbour& neighbour, glm::vec3 heading) {
    const float ahead = dot(neighbour.offset, heading);
    const glm::vec3 aside = neighbour.offset - heading * ahead;
    const float room = lengthOf(aside + heading * (ahead * kAbreastToFile));
    const float tooNear = std::max(0.0F, 1 - room / kSpacing);
    const float repulsion = tooNear * (1 + 2 * tooNear * tooNear);
    company.separation -=
        directionOf(aside + heading * (ahead * kAsideShare), {0, 1, 0}) * repulsion;
    company.brake += repulsion * std::max(0.0F, dot(neighbour.towards, heading));
}

// Of the same species one keeps with; to others one only gives way.
Company companyOf(const FishView& view, const Senses& senses, std::uint32_t fish) {
    Company company;
    const float perLength = 1 / view.length[fish];
    for (std::size_t i = 0; i < senses.others.count; ++i) {
        // Of a larger fish one stays clear by its length.
        const std::uint32_t other = senses.others.fish[i];
        const float per = std::min(perLength, 1 / view.length[other]);
        giveWay(company, neighbourOf(view, senses, other, per), senses.heading);
    }
    for (std::size_t i = 0; i < senses.schoolmates.count; ++i) {
        const std::uint32_t other = senses.schoolmates.fish[i];
        const Neighbour mate = neighbourOf(view, senses, other, perLength);
        giveWay(company, mate, senses.heading);
        const float tooFar =
            std::clamp((mate.distance - kSpacing) / (kAttractFully - kSpacing), 0.0F, 1.0F);
        const float inStep =
            std::clamp((kAttractFully - mate.distance) / (kAttractFully - kAlignFully), 0.0F, 1.0F);
        company.cohesion += mate.towards * tooFar;
        company.alignment += view.heading(other) * inStep;
        company.speed += view.speed[other] * perLength;
    }
    // Parting by more than a slant would bring the tails together.
    const float parting = lengthOf(company.separation) * kSeparate;
    if (parting > kMostSeparation) company.separation *= kMostSeparation / parting;
    if (senses.schoolmates.count == 0) return company;
    const float share = 1 / static_cast<float>(senses.schoolmates.count);
    company.alignment *= share;
    company.cohesion *= share;
    company.hurry = dot(company.cohesion, senses.heading);
    company.speed *= share;
    return company;
}

// Where the school as a whole goes: along with the goal, and towards it from outside the school.
glm::vec3 followed(const Goal& goal, glm::vec3 towards, float pull) {
    return directionOf(towards, {}) * pull + goal.velocityMetresPerSecond * 2.0F;
}

// Round the goal.
glm::vec3 circled(const Goal& goal, glm::vec3 towards, float pull) {
    const float turn = goal.mill > 0 ? 1.0F : -1.0F;
    const glm::vec3 around{-towards.z * turn, 0, towards.x * turn};
    return directionOf(around, {1, 0, 0}) * 1.6F + directionOf(towards, {}) * (pull + 0.3F);
}

glm::vec3 commonWay(const Goal& goal, glm::vec3 position, float schoolRadiusMetres) {
    const glm::vec3 towards = goal.position - position;
    const float outside = lengthOf(towards) - schoolRadiusMetres;
    const float pull = std::clamp(outside / schoolRadiusMetres, 0.0F, 1.5F);
    const glm::vec3 follow = followed(goal, towards, pull);
    if (goal.mill == 0) return follow;
    return follow + (circled(goal, towards, pull) - follow) * std::abs(goal.mill);
}

// A slow whim of each fish, so that no two hold quite the same course.
glm::vec3 whim(std::uint32_t seed, std::size_t fish, Tick tick) {
    const std::uint32_t own = hashOf(seed, static_cast<std::uint32_t>(fish));
    const float seconds = static_cast<float>(tick.value % (1U << 20U)) / 60.0F;
    return {valueNoise(own, {seconds * 0.5F, 0.5F}),
            0.6F * valueNoise(own, {seconds * 0.5F, 8.5F}),
            valueNoise(own, {seconds * 0.5F, 16.5F})};
}

// The pace of the goal and of those about, quicker where the school is ahead and slower behind
// others' tails.
float wantedSpeed(const Goal& goal, const Company& company, float behind, float perLength) {
    const float goalPace = lengthOf(goal.velocityMetresPerSecond) * perLength + 0.12F * behind;
    const float own = goalPace + (kMillPace - goalPace) * std::abs(goal.mill);
    const float pace = company.speed > 0 ? 0.5F * (own + company.speed) : own;
    return std::clamp(pace + company.hurry - company.brake, kSlowest, kFastest);
}

}  // namespace

float schoolRadiusMetres(std::size_t fish) {
    // A ball at one fish in (0.3 m)^3; grown in steps, as there is no exact cube root.
    float radius = 0.3F;
    while (radius * radius * radius < static_cast<float>(fish) * 0.015F) radius *= 1.1F;
    return radius;
}

Course school(const Situation& situation) {
    const Environment& environment = situation.environment;
    const FishView& view = *environment.view;
    const Senses& senses = situation.senses;
    const std::uint32_t fish = situation.fish;
    const Company company = companyOf(view, senses, fish);
    // What must be avoided comes before where one would like to go.
    const float follow = kFollow * std::max(0.0F, 1 - senses.urgency);
    glm::vec3 way{};
    if (environment.gathering != Gathering::None)
        way = commonWay(environment.goal, senses.position, environment.schoolRadiusMetres);
    const glm::vec3 wish = senses.heading * kKeepCourse + company.separation * kSeparate +
                           company.alignment * kAlign + company.cohesion * kCohere + way * follow +
                           whim(environment.seed, fish, environment.tick) * kWander + senses.push;
    const float perLength = 1 / senses.length;
    const float behind =
        dot(environment.goal.position - senses.position, senses.heading) * perLength;
    return {levelled(directionOf(wish, senses.heading)),
            wantedSpeed(environment.goal, company, behind, perLength),
            senses.urgency};
}

}  // namespace aquarama
