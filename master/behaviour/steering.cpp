// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/steering.h"

#include <algorithm>

#include "common/place/noise.h"
#include "master/behaviour/angle.h"
#include "master/behaviour/perception.h"

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
constexpr float kReachSeconds = 2.2F;  // how far ahead the surroundings are felt
constexpr float kReachMetres = 0.4F;

struct Company {
    glm::vec3 separation{}, alignment{}, cohesion{};
    float speed = 0;  // mean of theirs, body lengths a second
    float hurry = 0;  // to close up, body lengths a second
    float brake = 0;  // for those just ahead, body lengths a second
};

// Of the same species one keeps with; to others one only gives way.
Company companyOf(const SchoolView& view,
                  const Neighbours& neighbours,
                  std::size_t mates,
                  std::size_t fish) {
    Company company;
    std::size_t followed = 0;
    const glm::vec3 position = view.position(fish);
    const glm::vec3 heading = view.heading(fish);
    const float perLength = 1 / view.length[fish];
    for (std::size_t i = 0; i < neighbours.count; ++i) {
        const std::size_t other = neighbours.fish[i];
        // Of a larger fish one stays clear by its length.
        const float scale = std::min(perLength, 1 / view.length[other]);
        const glm::vec3 offset =
            (view.position(other) - position) * (other < mates ? perLength : scale);
        const float distance = lengthOf(offset);
        const glm::vec3 towards = directionOf(offset, {0, 1, 0});
        // Fish are long: in file they need more room than abreast; there the one behind brakes and
        // moves aside.
        const float ahead = dot(offset, heading);
        const glm::vec3 aside = offset - heading * ahead;
        const float room = lengthOf(aside + heading * (ahead * kAbreastToFile));
        const float tooNear = std::max(0.0F, 1 - room / kSpacing);
        const float repulsion = tooNear * (1 + 2 * tooNear * tooNear);
        const float tooFar =
            std::clamp((distance - kSpacing) / (kAttractFully - kSpacing), 0.0F, 1.0F);
        const float inStep =
            std::clamp((kAttractFully - distance) / (kAttractFully - kAlignFully), 0.0F, 1.0F);
        company.separation -=
            directionOf(aside + heading * (ahead * kAsideShare), {0, 1, 0}) * repulsion;
        company.brake += repulsion * std::max(0.0F, dot(towards, heading));
        if (other >= mates) continue;
        ++followed;
        company.cohesion += towards * tooFar;
        company.alignment += view.heading(other) * inStep;
        company.speed += view.speed[other] * perLength;
    }
    // Parting by more than a slant would bring the tails together.
    const float parting = lengthOf(company.separation) * kSeparate;
    if (parting > kMostSeparation) company.separation *= kMostSeparation / parting;
    if (followed == 0) return company;
    const float share = 1 / static_cast<float>(followed);
    company.alignment *= share;
    company.cohesion *= share;
    company.hurry = dot(company.cohesion, heading);
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

void Steering::run(std::size_t first, std::size_t last) const {
    for (std::size_t fish = first; fish < last; ++fish)
        if (thinksAt(tick, fish)) think(fish);
}

void Steering::think(std::size_t fish) const {
    const glm::vec3 position = view->position(fish);
    const glm::vec3 heading = view->heading(fish);
    const Neighbours neighbours = nearestVisible(*view, *grid, static_cast<std::uint32_t>(fish));
    const Company company = companyOf(*view, neighbours, schoolmates, fish);
    const float reach = kReachMetres + view->speed[fish] * kReachSeconds;
    const glm::vec3 push = avoidance(*surroundings, position, heading, reach);
    const float urgency = lengthOf(push);
    // What must be avoided comes before where one would like to go.
    const float follow = kFollow * std::max(0.0F, 1 - urgency);
    const glm::vec3 wish = heading * kKeepCourse + company.separation * kSeparate +
                           company.alignment * kAlign + company.cohesion * kCohere +
                           commonWay(goal, position, schoolRadius) * follow +
                           whim(seed, fish, tick) * kWander + push;
    const glm::vec3 direction = levelled(directionOf(wish, heading));
    intentions->directionX[fish] = direction.x;
    intentions->directionY[fish] = direction.y;
    intentions->directionZ[fish] = direction.z;
    intentions->urgency[fish] = urgency;

    const float perLength = 1 / view->length[fish];
    const float behind = dot(goal.position - position, heading) * perLength;
    intentions->speed[fish] = wantedSpeed(goal, company, behind, perLength);
}

}  // namespace aquarama
