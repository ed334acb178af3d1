// SPDX-License-Identifier: Apache-2.0
#include "master/study/diary.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "common/place/place.h"
#include "master/study/school_figures.h"

namespace aquarama {

namespace {

constexpr std::uint64_t kTicksBetweenGlances = 5;

}  // namespace

bool isInTerrain(const Obstacles& obstacles, const Rod& rod) {
    if (rod.length == 0) return false;
    const glm::vec3 at = rod.origin;
    if (at.y > -rod.halfWidth) return true;
    if (at.y < floorHeight(obstacles.place, {at.x, at.z}) + rod.halfWidth) return true;
    return std::ranges::any_of(obstacles.rocks, [&](const Rock& rock) {
        return glm::distance(rock.centre, at) < rock.radiusMetres + rod.halfWidth;
    });
}

Diary::Diary(const World& world, std::vector<float> halfWidths)
    : halfWidths_(std::move(halfWidths)),
      overlaps_(kTicksBetweenGlances),
      bumps_(world.view().size()),
      intention_(world.minds().intention),
      target_(world.minds().target),
      sinceMeal_(world.minds().sinceMeal) {}

void Diary::note(const World& world) {
    ++tally_.ticks;
    for (std::size_t fish = 0; fish < world.view().size(); ++fish)
        if (!world.view().shows(fish, kAway)) noteMind(world, fish);
    if (world.tick().value % kTicksBetweenGlances != 0) return;
    ++tally_.glances;
    noteBodies(world);
    noteSchool(world);
}

void Diary::noteMind(const World& world, std::size_t fish) {
    const Minds& minds = world.minds();
    const Intention intention = minds.intention[fish];
    const bool hunts = world.natures()[world.view().kind[fish]].role == Role::Predator;
    const bool isNew = intention != intention_[fish];
    const bool another = isNew || minds.target[fish] != target_[fish];
    ++tally_.fishTicks;
    ++tally_.intentionTicks.at(static_cast<std::size_t>(intention));
    tally_.changes += isNew ? 1 : 0;
    if (intention == Intention::Eat) {
        tally_.tries += !hunts && another ? 1 : 0;
        tally_.chases += hunts && isNew ? 1 : 0;
    }
    if (minds.sinceMeal[fish] < sinceMeal_[fish]) ++(hunts ? tally_.catches : tally_.particles);
    intention_[fish] = intention;
    target_[fish] = minds.target[fish];
    sinceMeal_[fish] = minds.sinceMeal[fish];
}

void Diary::noteBodies(const World& world) {
    rodsOf(world.view(), halfWidths_, rods_);
    const std::uint64_t before = overlaps_.pairTicks();
    tally_.touches += overlaps_.note(world.tick(), rods_).size();
    tally_.overlapTicks += 2 * static_cast<double>(overlaps_.pairTicks() - before);
    for (std::size_t fish = 0; fish < rods_.size(); ++fish) {
        const bool bumps = isInTerrain(world.surroundings().obstacles, rods_[fish]);
        tally_.bumps += bumps && bumps_[fish] == 0 ? 1 : 0;
        bumps_[fish] = bumps ? 1 : 0;
    }
}

void Diary::noteSchool(const World& world) {
    const Nature& first = world.natures().front();
    const SchoolFigures figures = schoolFigures(world.view(), first.first, first.last);
    tally_.nearestNeighbour += figures.nearestNeighbour;
    tally_.polarisation += figures.polarisation;
    tally_.rotation += figures.rotation;
    const Synchrony synchrony = synchronyOf(world.states(), first.first, first.last);
    tally_.resultant += synchrony.resultant;
    tally_.sameSegment += synchrony.sameSegment;
    tally_.inStep += synchrony.inStep;
}

}  // namespace aquarama
