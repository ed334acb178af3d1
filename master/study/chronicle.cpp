// SPDX-License-Identifier: Apache-2.0
#include "master/study/chronicle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/place/place.h"
#include "master/behaviour/routines.h"
#include "master/study/quantities.h"

namespace aquarama::study {

namespace {

// Intervals along a middle line between sampled points.
constexpr int kSamples = 32;

// A point of the middle line; `behindNose` is a share of the length.
glm::vec3 pointOf(const Rod& rod, float behindNose) {
    return rod.origin + rod.heading * (rod.length * (fish::kNoseBodyLengths - behindNose));
}

// From a point to the middle line of a rod.
float distanceTo(const Rod& rod, glm::vec3 point) {
    const float along = glm::dot(point - rod.origin, rod.heading);
    const float nearest = std::clamp(
        along, (fish::kNoseBodyLengths - 1) * rod.length, fish::kNoseBodyLengths * rod.length);
    return glm::distance(point, rod.origin + rod.heading * nearest);
}

// Quick test by the distance of the origins. The tail is the longer part behind the origin, so that
// nothing of a body is farther away than it.
bool mayTouch(const Rod& a, const Rod& b, float room) {
    const float reach = (1 - fish::kNoseBodyLengths) * (a.length + b.length) + room;
    const glm::vec3 apart = b.origin - a.origin;
    return glm::dot(apart, apart) < reach * reach;
}

}  // namespace

void rodsOf(const fish::FishView& view, std::span<const float> halfWidths, std::vector<Rod>& rods) {
    rods.resize(view.size());
    for (std::size_t fish = 0; fish < view.size(); ++fish) {
        const float length = view.shows(fish, fish::kAway) ? 0.0F : view.fish[fish].length;
        rods[fish] = {
            view.position(fish), view.heading(fish), length, length * halfWidths[view.kind[fish]]};
    }
}

float distanceBetween(const Rod& a, const Rod& b) {
    float nearest = distanceTo(b, pointOf(a, 0));
    for (int i = 1; i <= kSamples; ++i)
        nearest = std::min(nearest, distanceTo(b, pointOf(a, static_cast<float>(i) / kSamples)));
    return nearest;
}

float overlapOf(const Rod& a, const Rod& b) {
    if (a.length == 0 || b.length == 0) return 0;
    const float room = a.halfWidth + b.halfWidth;
    if (!mayTouch(a, b, room)) return 0;
    const Rod& shorter = a.length < b.length ? a : b;
    const Rod& other = a.length < b.length ? b : a;
    int inside = 0;
    for (int i = 0; i <= kSamples; ++i)
        inside += distanceTo(other, pointOf(shorter, static_cast<float>(i) / kSamples)) < room;
    return static_cast<float>(inside) / (kSamples + 1);
}

std::span<const BodyOverlap> OverlapLog::note(Tick tick,
                                              std::span<const Rod> rods,
                                              std::span<const fish::Intention> intentions) {
    assert(rods.size() == intentions.size());
    fresh_.clear();
    for (std::uint32_t a = 0; a < rods.size(); ++a)
        for (std::uint32_t b = a + 1; b < rods.size(); ++b)
            if (const float share = overlapOf(rods[a], rods[b]); share > 0)
                meet({.a = a,
                      .b = b,
                      .intentionOfA = intentions[a],
                      .intentionOfB = intentions[b],
                      .from = tick},
                     share);
    // Pairs that did not meet at this glance have ended.
    std::erase_if(open_, [&](const auto& entry) {
        if (entry.second.last.value == tick.value) return false;
        ended_.push_back(entry.second.overlap);
        return true;
    });
    return fresh_;
}

// Begins or continues the overlap of a pair; a glance stands for all ticks since the last one.
void OverlapLog::meet(const BodyOverlap& overlap, float share) {
    const auto [entry, isNew] =
        open_.try_emplace({overlap.a, overlap.b}, Open{overlap, 0, overlap.from});
    if (isNew) fresh_.push_back(overlap);
    Open& open = entry->second;
    open.last = overlap.from;
    open.overlap.ticks += between_;
    open.overlap.deepest = std::max(open.overlap.deepest, share);
    open.deepRun = share > kDeepShare ? open.deepRun + between_ : 0;
    open.overlap.deepTicks = std::max(open.overlap.deepTicks, open.deepRun);
    pairTicks_ += between_;
}

std::vector<BodyOverlap> OverlapLog::all() const {
    std::vector<BodyOverlap> all = ended_;
    for (const auto& [pair, open] : open_) all.push_back(open.overlap);
    return all;
}

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

}  // namespace

SpeciesLog::SpeciesLog(const world::World& world)
    : tallies_(world.speciesParameters().size()), fish_(world.view().size()) {}

void SpeciesLog::note(const world::World& world) {
    assert(world.view().size() == fish_.size());
    const bool glances = world.tick().value % kTicksOfSlip == 0;
    for (std::size_t fish = 0; fish < fish_.size(); ++fish) noteFish(world, fish, glances);
}

// The view shows the world before the tick, so it shows what the commands of the tick before did.
void SpeciesLog::noteFish(const world::World& world, std::size_t fish, bool glances) {
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
        tally.captured += static_cast<double>(std::abs(turned - seen.addedYaw));
        tally.added += static_cast<double>(std::abs(seen.addedYaw));
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
    seen.heading = now.heading;
    seen.addedYaw = motion::kYawUnit * static_cast<float>(world.commands().yawRate[fish]);
    seen.command = command;
    seen.intention = world.minds()[fish].intention;
    seen.eaten = world.minds()[fish].eaten;
    seen.sinceMeal = world.minds()[fish].sinceMeal;
    seen.isNew = false;
}

void SpeciesLog::noteLife(const fish::Mind& mind, const Fish& fish, SpeciesTally& tally) {
    const auto begins = [&](fish::Intention intention) {
        return mind.intention == intention && fish.intention != intention ? 1U : 0U;
    };
    // What was eaten since the last thought; time passes in thoughts. After a digested meal the
    // next one has its number again.
    const bool isAnother = mind.eaten != fish.eaten || fish.sinceMeal != 0;
    tally.meals += mind.sinceMeal == 0 && isAnother ? 1 : 0;
    tally.flights += begins(fish::Intention::Escape);
    tally.courtships += begins(fish::Intention::Mate);
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
        sum.captured += tally.captured;
        sum.added += tally.added;
        sum.changes += tally.changes;
        sum.fishSeconds += tally.fishSeconds;
        sum.meals += tally.meals;
        sum.flights += tally.flights;
        sum.courtships += tally.courtships;
        for (std::size_t i = 0; i < sum.meanSlip.size(); ++i) {
            sum.meanSlip.at(i) += tally.meanSlip.at(i);
            sum.bodySlip.at(i) += tally.bodySlip.at(i);
        }
    }
    return sum;
}

namespace {

constexpr std::uint64_t kTicksBetweenGlances = 5;

}  // namespace

// The surface is at y = 0; the half-width keeps the back of the fish under it.
bool isInTerrain(const surroundings::Obstacles& obstacles, const Rod& rod) {
    if (rod.length == 0) return false;
    const glm::vec3 at = rod.origin;
    if (at.y > -rod.halfWidth) return true;
    if (at.y < place::floorHeight(obstacles.place, {at.x, at.z}) + rod.halfWidth) return true;
    return std::ranges::any_of(obstacles.rocks, [&](const place::Rock& rock) {
        return glm::distance(rock.centre, at) < rock.radiusMetres + rod.halfWidth;
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
    if (intention == fish::Intention::Eat && !hunts && another) {
        ++tally_.tries;
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
    const std::uint64_t before = overlaps_.pairTicks();
    tally_.touches += overlaps_.note(world.tick(), rods_, intention_).size();
    tally_.overlapTicks += 2 * static_cast<double>(overlaps_.pairTicks() - before);
    for (std::size_t fish = 0; fish < rods_.size(); ++fish) {
        const bool bumps = isInTerrain(world.surroundings().obstacles, rods_[fish]);
        tally_.bumps += bumps && bumps_[fish] == 0 ? 1 : 0;
        bumps_[fish] = bumps ? 1 : 0;
    }
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

namespace {

// Ticks between two notes of the places of all fish.
constexpr std::uint64_t kTicksBetweenSteps = 30;
constexpr double kTicksOfMinute = 60.0 * kTicksPerSecond;

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
            now.returns - before.returns};
}

}  // namespace

Chronicle::Chronicle(const world::World& world,
                     std::vector<float> halfWidths,
                     std::uint64_t ticksOfHour)
    : diary_(world, std::move(halfWidths)),
      species_(world),
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

// A fish that is away makes no way, and starts anew where it comes back.
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
    if (glm::distance(place, way.anchor) > kStayMetres) {
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
    const double perFishMinute = kTicksOfMinute / fishTicks;
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
