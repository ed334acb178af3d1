// SPDX-License-Identifier: Apache-2.0
#include "master/study/species_log.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

#include "common/motion/motion_state.h"
#include "common/place/place.h"

namespace aquarama::study {

namespace {

constexpr std::uint64_t kTicksOfSlip = 30;

// The columns of a command in one number.
std::uint64_t packed(const motion::MotorCommands& commands, std::size_t fish) {
    const auto bits = [](std::int16_t value) {
        return std::uint64_t{static_cast<std::uint16_t>(value)};
    };
    return std::uint64_t{commands.action[fish]} | std::uint64_t{commands.brake[fish]} << 8U |
           bits(commands.phaseRate[fish]) << 16U | bits(commands.pitch[fish]) << 32U |
           bits(commands.yawRate[fish]) << 48U;
}

// Degrees between two directions, which need not be of unit length, rounded up.
std::size_t degreesBetween(glm::vec3 a, glm::vec3 b) {
    const float cosine = glm::dot(glm::normalize(a), glm::normalize(b));
    const float degrees = std::acos(std::clamp(cosine, -1.0F, 1.0F)) / kRadiansPerDegree<float>;
    return static_cast<std::size_t>(std::min(std::ceil(degrees), 90.0F));
}

// 1 where a fish begins an intention, else 0.
std::uint64_t begins(fish::Intention intention, fish::Intention before, fish::Intention now) {
    return now == intention && before != intention ? 1 : 0;
}

}  // namespace

int quantileDegrees(const std::array<std::uint64_t, 91>& slip, double share) {
    const auto all = std::accumulate(slip.begin(), slip.end(), std::uint64_t{0});
    std::uint64_t within = 0;
    for (std::size_t degrees = 0; degrees < slip.size(); ++degrees) {
        within += slip.at(degrees);
        if (static_cast<double>(within) >= share * static_cast<double>(all))
            return static_cast<int>(degrees);
    }
    return 0;
}

SpeciesLog::SpeciesLog(const world::World& world, std::span<const world::WorldSpecies> cast)
    : tallies_(world.speciesParameters().size()),
      fish_(world.view().size()),
      spawnings_(world.counts().spawnings) {
    for (const world::WorldSpecies& species : cast) tables_.push_back(species.tables);
    assert(tables_.size() == tallies_.size());
}

void SpeciesLog::note(const world::World& world) {
    assert(world.view().size() == fish_.size());
    const bool glances = world.tick().value % kTicksOfSlip == 0;
    noteSpawnings(world);
    for (std::size_t fish = 0; fish < fish_.size(); ++fish) noteFish(world, fish, glances);
}

void SpeciesLog::noteSpawnings(const world::World& world) {
    if (world.counts().spawnings == spawnings_) return;
    spawnings_ = world.counts().spawnings;
    for (std::size_t fish = 0; fish < fish_.size(); ++fish)
        if (spawned(world, fish)) ++tallies_[world.view().kind[fish]].spawnings;
}

// Whether a fish spawned in this tick, as the first of its pair. Where a pair spawns, its clocks
// begin anew at once; who gives up a courtship begins anew alone.
bool SpeciesLog::spawned(const world::World& world, std::size_t fish) const {
    const auto beginsAnew = [&](std::size_t one) {
        return world.minds()[one].sinceSpawning == 0 && fish_[one].sinceSpawning != 0;
    };
    const fish::Aim aim = fish::aimOf(world.minds()[fish]);
    return beginsAnew(fish) && aim.intention == fish::Intention::Mate && fish < aim.target &&
           beginsAnew(aim.target);
}

// The view shows the world before the tick, so it shows what the commands of the tick before did.
void SpeciesLog::noteFish(const world::World& world, std::size_t fish, bool glances) {
    constexpr float kRadiansOfUnit = 1.0F / (1 << 20);  // of MotorCommands::yawRate
    Fish& seen = fish_[fish];
    SpeciesTally& tally = tallies_[world.view().kind[fish]];
    if (world.view().shows(fish, fish::kAway)) {
        seen.isNew = true;
        return;
    }
    const fish::VisibleFish& now = world.view().fish[fish];
    const std::uint64_t command = packed(world.commands(), fish);
    if (!seen.isNew) {
        const float turned = place::yawBetween(seen.heading, now.heading);
        tally.heading.add(static_cast<double>(turned), static_cast<double>(seen.addedYaw));
        const float pitched = std::asin(std::clamp(now.heading.y, -1.0F, 1.0F)) -
                              std::asin(std::clamp(seen.heading.y, -1.0F, 1.0F));
        tally.pitch.add(static_cast<double>(pitched), static_cast<double>(seen.addedPitch));
        noteWay(world, fish, tally);
        tally.changes += command != seen.command ? 1 : 0;
        tally.fishSeconds += 1.0 / kTicksPerSecond;
        if (command != seen.command) commands_.insert(command);
        noteLife(world.minds()[fish], seen, tally);
    }
    seen.faces += now.heading;
    seen.bodies += motion::bodyFrameOf(world.states(), fish).rotation * glm::vec3(1, 0, 0);
    if (glances && !seen.isNew) noteSlip(now, seen, tally);
    if (glances || seen.isNew) {
        seen.from = now.position;
        seen.faces = seen.bodies = glm::vec3{};
    }
    // The path is that through the water, which carried the fish in this tick.
    const surroundings::Surroundings& around = world.surroundings();
    seen.from += around.current.at(now.position, around.openCurrent) *
                 (1.0F / static_cast<float>(kTicksPerSecond));
    seen.heading = now.heading;
    seen.addedYaw = kRadiansOfUnit * static_cast<float>(world.commands().yawRate[fish]);
    seen.addedPitch = addedPitch(world, fish);
    seen.command = command;
    seen.intention = world.minds()[fish].intention;
    seen.aim = fish::aimOf(world.minds()[fish]).intention;
    seen.sinceSpawning = world.minds()[fish].sinceSpawning;
    seen.eaten = world.minds()[fish].eaten;
    seen.sinceMeal = world.minds()[fish].sinceMeal;
    const bool startles = world.view().shows(fish, fish::kStartled);
    tally.fastStarts += startles && !seen.startles ? 1 : 0;
    seen.startles = startles;
    seen.isNew = false;
}

float SpeciesLog::addedPitch(const world::World& world, std::size_t fish) const {
    const float wanted = static_cast<float>(world.commands().pitch[fish]) * motion::kPitchUnit;
    const float most = tablesOf(world, fish).pitchRate[world.states().segment[fish]];
    const float steered = motion::kPitchGain * (wanted - world.view().fish[fish].heading.y);
    return std::clamp(steered, -most, most);
}

// A glide plays no way: a fish that coasts does so by the law of its speed.
void SpeciesLog::noteWay(const world::World& world, std::size_t fish, SpeciesTally& tally) const {
    const motion::MotionStates& states = world.states();
    const motion::SegmentTables& played = tablesOf(world, fish).segments[states.segment[fish]];
    const bool glides = motion::actionOf(states.segment[fish]) == motion::Action::Glide;
    const float perRate =
        played.path[states.phase[fish] >> motion::kPhaseCellBits].translationAndSpeed[3];
    const float rate = played.playsToEnd ? played.phaseRate : world.commands().phaseRate[fish];
    const float path = glides ? 0.0F : perRate * rate / motion::kSpeedUnitsPerBodyLength;
    const float speed = motion::speedBodyLengths(states, fish);
    constexpr double kTickSeconds = 1.0 / kTicksPerSecond;
    // A fish that gathers speed travels less than it plays; nothing is added to that.
    const float swum = path * speed > 0 ? std::min(std::abs(path), std::abs(speed)) : 0;
    tally.way.captured += kTickSeconds * static_cast<double>(swum);
    tally.way.added += kTickSeconds * static_cast<double>(std::abs(speed) - swum);
}

void SpeciesLog::noteLife(const fish::Mind& mind, const Fish& fish, SpeciesTally& tally) {
    // What was eaten since the last thought; time passes in thoughts. After a digested meal the
    // next one has its number again.
    const bool isAnother = mind.eaten != fish.eaten || fish.sinceMeal != 0;
    tally.meals += mind.sinceMeal == 0 && isAnother ? 1 : 0;
    tally.flights += begins(fish::Intention::Escape, fish.intention, mind.intention);
    tally.courtships += begins(fish::Intention::Mate, fish.intention, mind.intention);
    tally.dives += begins(fish::Intention::Hide, fish.aim, fish::aimOf(mind).intention);
}

void SpeciesLog::noteSlip(const fish::VisibleFish& now, const Fish& fish, SpeciesTally& tally) {
    const glm::vec3 path = now.position - fish.from;
    constexpr float kSeconds =
        static_cast<float>(kTicksOfSlip) / static_cast<float>(kTicksPerSecond);
    if (now.speed < 0 || glm::length(path) < kSlowestPath * now.length * kSeconds) return;
    ++tally.meanSlip.at(degreesBetween(path, fish.faces));
    ++tally.bodySlip.at(degreesBetween(path, fish.bodies));
}

SpeciesTally SpeciesLog::all() const {
    SpeciesTally sum;
    for (const SpeciesTally& tally : tallies_) {
        sum.heading.add(tally.heading);
        sum.pitch.add(tally.pitch);
        sum.way.add(tally.way);
        sum.changes += tally.changes;
        sum.fishSeconds += tally.fishSeconds;
        sum.meals += tally.meals;
        sum.flights += tally.flights;
        sum.dives += tally.dives;
        sum.courtships += tally.courtships;
        sum.spawnings += tally.spawnings;
        sum.fastStarts += tally.fastStarts;
        for (std::size_t i = 0; i < sum.meanSlip.size(); ++i) {
            sum.meanSlip.at(i) += tally.meanSlip.at(i);
            sum.bodySlip.at(i) += tally.bodySlip.at(i);
        }
    }
    return sum;
}

}  // namespace aquarama::study
