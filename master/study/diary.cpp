// SPDX-License-Identifier: Apache-2.0
#include "master/study/diary.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <glm/geometric.hpp>

#include "common/place/place.h"
#include "master/behaviour/routines.h"
#include "master/study/occupation.h"
#include "master/study/quantities.h"

namespace aquarama::study {

namespace {

constexpr std::uint64_t kTicksBetweenGlances = 5;

}  // namespace

// The surface is at y = 0; the half-width keeps the back of the fish under it.
bool isInTerrain(const place::Obstacles& obstacles, const Rod& rod) {
    if (rod.length == 0) return false;
    const glm::vec3 at = rod.origin;
    if (at.y > -rod.halfWidth) return true;
    if (at.y < place::floorHeight(obstacles.place, {at.x, at.z}) + rod.halfWidth) return true;
    return std::ranges::any_of(obstacles.rocks, [&](const place::Rock& rock) {
        return glm::distance(rock.centre, at) < place::kDrawnRadii * rock.radiusMetres;
    });
}

Diary::Diary(const world::World& world, std::vector<float> halfWidths)
    : halfWidths_(std::move(halfWidths)),
      overlaps_(kTicksBetweenGlances),
      bumps_(world.view().size()),
      intention_(world.view().size()),
      target_(world.view().size()),
      rushes_(world.view().size()),
      before_(world.counts()) {
    assert(!world.speciesParameters().empty());
    assert(halfWidths_.size() == world.speciesParameters().size());
    for (std::size_t fish = 0; fish < intention_.size(); ++fish) {
        intention_[fish] = world.minds()[fish].intention;
        target_[fish] = world.minds()[fish].target;
    }
}

void Diary::note(const world::World& world) {
    assert(world.view().size() == intention_.size());
    ++tally_.ticks;
    tally_.particles = world.counts().meals - before_.meals;
    tally_.catches = world.counts().catches - before_.catches;
    for (std::size_t fish = 0; fish < world.view().size(); ++fish)
        if (!world.view().shows(fish, fish::kAway)) noteMind(world, fish);
    if (world.tick().value % kTicksBetweenGlances != 0) return;
    ++tally_.glances;
    noteBodies(world);
    noteSchool(world);
}

void Diary::noteMind(const world::World& world, std::size_t fish) {
    const fish::Minds& minds = world.minds();
    const fish::Intention intention = minds[fish].intention;
    const bool hunts =
        world.speciesParameters()[world.view().kind[fish]].habits.role == config::Role::Predator;
    const bool isNew = intention != intention_[fish];
    // A try is a new target, also when the intention stays.
    const bool another = isNew || minds[fish].target != target_[fish];
    ++tally_.fishTicks;
    ++tally_.intentionTicks.at(static_cast<std::size_t>(intention));
    tally_.changes += isNew ? 1 : 0;
    if (intention == fish::Intention::Eat && !hunts) {
        ++tally_.pursuitTicks;
        tally_.tries += another ? 1 : 0;
    }
    const bool rushes = hunts && intention == fish::Intention::Eat &&
                        minds[fish].stage == static_cast<std::uint8_t>(behaviour::HuntStage::Rush);
    // Counts the beginning of a rush, not its ticks.
    tally_.rushes += rushes && rushes_[fish] == 0 ? 1 : 0;
    rushes_[fish] = rushes ? 1 : 0;
    intention_[fish] = intention;
    target_[fish] = minds[fish].target;
}

void Diary::noteBodies(const world::World& world) {
    rodsOf(world.view(), halfWidths_, rods_);
    const StudiedFish studied{world.view(), world.minds(), world.speciesParameters()};
    for (std::uint32_t fish = 0; fish < rods_.size(); ++fish) {
        // Those in a shelter lie close together: they count for nothing.
        if (isSheltered(studied, fish)) rods_[fish].length = 0;
        const bool bumps = isInTerrain(world.surroundings().obstacles, rods_[fish]);
        tally_.bumps += bumps && bumps_[fish] == 0 ? 1 : 0;
        bumps_[fish] = bumps ? 1 : 0;
    }
    const std::uint64_t before = overlaps_.pairTicks();
    tally_.touches += overlaps_.note(world.tick(), rods_, intention_).size();
    tally_.overlapTicks += 2 * static_cast<double>(overlaps_.pairTicks() - before);
}

void Diary::noteSchool(const world::World& world) {
    const fish::SpeciesParameters& first = world.speciesParameters().front();
    const SchoolFigures figures = schoolFigures(world.view(), first.first, first.last);
    tally_.nearestNeighbour += figures.nearestNeighbour;
    tally_.polarisation += figures.polarisation;
    tally_.rotation += figures.rotation;
    const Synchrony synchrony = synchronyOf(world.states(), first.first, first.last);
    tally_.resultant += synchrony.resultant;
    tally_.sameSegment += synchrony.sameSegment;
    tally_.inStep += synchrony.inStep;
}

}  // namespace aquarama::study
