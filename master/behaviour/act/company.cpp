// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/act/company.h"

#include <algorithm>

#include "common/place/angle.h"

namespace aquarama::behaviour {

namespace {

// Distances in body lengths. Huth & Wissel 1992 have zones (repulse 0.5, align 2, attract 5); here
// the zones fade into one another, so that the school settles at its spacing instead of dithering
// at a border.
constexpr float kAbreastToFile = 0.6F;  // room abreast for room in file
constexpr float kAsideShare = 0.25F;    // of a push in file that is along it: the rest is sideways
constexpr float kAlignFully = 2.0F;
constexpr float kAttractFully = 5.0F;
constexpr float kAttractAlarmed = 1.5F;
constexpr float kHuddle = 1.5F;  // times as much more, alarmed

constexpr float kSeparate = 2.2F;  // weights against the unit vector of one's own course
constexpr float kMostSeparation = 0.9F;
constexpr float kAlign = 0.9F;
constexpr float kCohere = 1.2F;

constexpr float kGiveWay = 1.5F;          // of one that keeps to itself
constexpr float kRoomBodyLengths = 1.2F;  // of the longer of two fish

constexpr float kNowhere = 1.0e-6F;  // lengths: no way leads to what is nearer

struct Neighbour {
    glm::vec3 offset;  // in lengths: of the fish itself, or of a larger one that it meets
    glm::vec3 towards;
    float distance;
};

Neighbour neighbourOf(const fish::FishView& view,
                      const Senses& senses,
                      std::uint32_t other,
                      float per) {
    const glm::vec3 offset = (view.position(other) - senses.position) * per;
    const float distance = place::lengthOf(offset);
    return {offset, distance > kNowhere ? offset / distance : glm::vec3{0, 1, 0}, distance};
}

// Fish are long: in file they need more room than abreast; there the one behind brakes and moves
// aside.
void giveWay(Company& company, const Neighbour& neighbour, glm::vec3 heading, float spacing) {
    const float ahead = place::dot(neighbour.offset, heading);
    const glm::vec3 aside = neighbour.offset - heading * ahead;
    const float room = place::lengthOf(aside + heading * (ahead * kAbreastToFile));
    if (room >= spacing) return;
    const float tooNear = 1 - room / spacing;
    const float repulsion = tooNear * (1 + 2 * tooNear * tooNear);
    company.separation -=
        place::directionOf(aside + heading * (ahead * kAsideShare), {0, 1, 0}) * repulsion;
    company.brake += repulsion * std::max(0.0F, place::dot(neighbour.towards, heading));
}

glm::vec3 roomFromThose(const Situation& situation, const Neighbours& those) {
    const fish::FishView& view = *situation.environment.view;
    const Senses& senses = situation.senses;
    glm::vec3 away{};
    for (std::size_t i = 0; i < those.count; ++i) {
        const std::uint32_t other = those.fish[i];
        if ((situation.parameters.hunts >> view.kind[other] & 1U) != 0) continue;
        const float room = kRoomBodyLengths * std::max(senses.length, view.fish[other].length);
        const glm::vec3 offset = view.position(other) - senses.position;
        const float tooNear = std::max(0.0F, 1 - place::lengthOf(offset) / room);
        away -= place::directionOf(offset, {0, 1, 0}) * (kGiveWay * tooNear);
    }
    return away;
}

}  // namespace

Company companyOf(const fish::FishView& view,
                  const Senses& senses,
                  std::uint32_t fish,
                  float alarm) {
    Company company;
    const float perLength = 1 / view.fish[fish].length;
    const float spacing = kSpacing + (kAlarmedSpacing - kSpacing) * alarm;
    const float attract = kAttractFully + (kAttractAlarmed - kAttractFully) * alarm;
    for (std::size_t i = 0; i < senses.others.count; ++i) {
        // Of a larger fish one stays clear by its length.
        const std::uint32_t other = senses.others.fish[i];
        const float per = std::min(perLength, 1 / view.fish[other].length);
        giveWay(company, neighbourOf(view, senses, other, per), senses.heading, spacing);
    }
    for (std::size_t i = 0; i < senses.schoolmates.count; ++i) {
        const std::uint32_t other = senses.schoolmates.fish[i];
        const Neighbour mate = neighbourOf(view, senses, other, perLength);
        giveWay(company, mate, senses.heading, spacing);
        const float tooFar =
            std::clamp((mate.distance - spacing) / (attract - spacing), 0.0F, 1.0F);
        const float inStep =
            std::clamp((kAttractFully - mate.distance) / (kAttractFully - kAlignFully), 0.0F, 1.0F);
        company.cohesion += mate.towards * tooFar;
        company.alignment += view.heading(other) * inStep;
        company.speed += view.fish[other].speed * perLength;
    }
    // Parting by more than a slant would bring the tails together.
    const float parting = place::lengthOf(company.separation) * kSeparate;
    if (parting > kMostSeparation) company.separation *= kMostSeparation / parting;
    if (senses.schoolmates.count == 0) return company;
    const float share = 1 / static_cast<float>(senses.schoolmates.count);
    company.alignment *= share;
    company.cohesion *= share * (1 + kHuddle * alarm);
    company.hurry = place::dot(company.cohesion, senses.heading);
    company.speed *= share;
    return company;
}

glm::vec3 pullOf(const Company& company) {
    return company.separation * kSeparate + company.alignment * kAlign + company.cohesion * kCohere;
}

glm::vec3 roomFrom(const Situation& situation) {
    return roomFromThose(situation, situation.senses.schoolmates) +
           roomFromThose(situation, situation.senses.others);
}

}  // namespace aquarama::behaviour
