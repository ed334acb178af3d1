// SPDX-License-Identifier: Apache-2.0
#include "master/study/chronicle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/base/units.h"
#include "common/place/place.h"

namespace aquarama::study {

namespace {

// Ticks between two notes of the places of all fish.
constexpr std::uint64_t kTicksBetweenSteps = 30;

// Cells of a cubic metre along each axis, at least one.
glm::ivec3 cubicMetres(const place::Region& water) {
    return glm::max(glm::ivec3(glm::ceil(2.0F * water.halfExtent)), 1);
}

// Index of the cubic metre that a place is in; places outside count to the border.
std::size_t cellOf(const place::Region& water, glm::vec3 place) {
    const glm::ivec3 size = cubicMetres(water);
    const glm::ivec3 cell = glm::clamp(
        glm::ivec3(glm::floor(place - water.centre + water.halfExtent)), glm::ivec3(0), size - 1);
    return static_cast<std::size_t>((cell.z * size.y + cell.y) * size.x + cell.x);
}

world::WorldCounts since(const world::WorldCounts& before, const world::WorldCounts& now) {
    return {now.meals - before.meals,
            now.catches - before.catches,
            now.spawnings - before.spawnings,
            now.returns - before.returns,
            now.bites - before.bites,
            now.puffs - before.puffs,
            now.charges - before.charges};
}

}  // namespace

Chronicle::Chronicle(const world::World& world,
                     std::vector<float> halfWidths,
                     std::span<const world::WorldSpecies> cast,
                     std::uint64_t ticksOfHour)
    : diary_(world, std::move(halfWidths)),
      species_(world, cast),
      ticksOfHour_(ticksOfHour),
      counts_(world.counts()),
      ways_(world.view().size()) {
    assert(ticksOfHour_ > 0);
    for (std::size_t fish = 0; fish < ways_.size(); ++fish)
        ways_[fish].last = ways_[fish].anchor = world.view().position(fish);
    beginHour(world);
}

void Chronicle::beginHour(const world::World& world) {
    now_ = {};
    now_.fewest = static_cast<std::uint32_t>(ways_.size());
    now_.farthestOutMetres = -1e3F;
    before_ = diary_.tally();
    countsBefore_ = counts_;
    for (Way& way : ways_) way.metres = 0;
    const glm::ivec3 size = cubicMetres(world.surroundings().obstacles.water);
    visited_.assign(static_cast<std::size_t>(size.x * size.y * size.z), 0);
    squares_ = samples_ = 0;
}

void Chronicle::note(const world::World& world) {
    diary_.note(world);
    species_.note(world);
    counts_ = world.counts();
    ++now_.ticks;
    if (now_.ticks % kTicksBetweenSteps == 0) notePlaces(world);
    if (now_.ticks < ticksOfHour_) return;
    done_.push_back(finished(now_));
    beginHour(world);
}

// Spread and way of all fish. The middle is that of the fish that are there.
void Chronicle::notePlaces(const world::World& world) {
    const fish::FishView& view = world.view();
    std::uint32_t there = 0;
    glm::vec3 middle{};
    for (std::size_t fish = 0; fish < ways_.size(); ++fish) {
        if (view.shows(fish, fish::kAway)) continue;
        ++there;
        middle += view.position(fish);
    }
    now_.fewest = std::min(now_.fewest, there);
    middle /= static_cast<float>(std::max(there, 1U));
    for (std::size_t fish = 0; fish < ways_.size(); ++fish) {
        noteWay(world, fish);
        if (view.shows(fish, fish::kAway)) continue;
        const glm::vec3 from = view.position(fish) - middle;
        squares_ += static_cast<double>(glm::dot(from, from));
        ++samples_;
    }
}

// A fish that is away makes no way, and starts anew where it comes back. One that rests is meant to
// stay.
void Chronicle::noteWay(const world::World& world, std::size_t fish) {
    Way& way = ways_[fish];
    const glm::vec3 place = world.view().position(fish);
    const std::uint64_t tick = world.tick().value;
    const place::Region& water = world.surroundings().obstacles.water;
    if (world.view().shows(fish, fish::kAway)) {
        way.last = way.anchor = place;
        way.anchoredAt = tick;
        return;
    }
    // Length of the way from steps of half a second.
    way.metres += static_cast<double>(glm::distance(place, way.last));
    way.last = place;
    const bool rests = fish::aimOf(world.minds()[fish]).intention == fish::Intention::Rest;
    if (rests || glm::distance(place, way.anchor) > kStayMetres) {
        way.anchor = place;
        way.anchoredAt = tick;
    }
    const double stay = static_cast<double>(tick - way.anchoredAt) / kTicksPerSecond;
    if (stay > now_.longestStaySeconds) {
        now_.longestStaySeconds = stay;
        now_.whoStayed = static_cast<std::uint32_t>(fish);
    }
    const glm::vec3 out = glm::abs(place - water.centre) - water.halfExtent;
    now_.farthestOutMetres = std::max({now_.farthestOutMetres, out.x, out.y, out.z});
    visited_[cellOf(water, place)] = 1;
}

// Figures of an hour from the differences of sums since it began.
Hour Chronicle::finished(const Hour& hour) const {
    Hour whole = hour;
    const Tally& tally = diary_.tally();
    const double fishTicks = tally.fishTicks - before_.fishTicks;
    const double perFishMinute = kTicksPerMinute / fishTicks;
    for (std::size_t i = 0; i < fish::kIntentions; ++i)
        whole.intentionShare.at(i) =
            (tally.intentionTicks.at(i) - before_.intentionTicks.at(i)) / fishTicks;
    whole.counts = since(countsBefore_, counts_);
    whole.changes = static_cast<double>(tally.changes - before_.changes) * perFishMinute;
    whole.touches = 2 * static_cast<double>(tally.touches - before_.touches) * perFishMinute;
    whole.overlapPercent = 100 * (tally.overlapTicks - before_.overlapTicks) / fishTicks;
    whole.bumps = tally.bumps - before_.bumps;
    whole.shortestWayMetres = static_cast<float>(std::ranges::min(ways_, {}, &Way::metres).metres);
    whole.spreadMetres = static_cast<float>(std::sqrt(squares_ / std::max(samples_, 1.0)));
    whole.waterUsedPercent = 100 * static_cast<double>(std::ranges::count(visited_, 1)) /
                             static_cast<double>(visited_.size());
    return whole;
}

std::vector<Hour> Chronicle::hours() const {
    std::vector<Hour> hours = done_;
    if (now_.ticks * 2 > ticksOfHour_) hours.push_back(finished(now_));
    return hours;
}

}  // namespace aquarama::study
