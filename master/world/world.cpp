// SPDX-License-Identifier: Apache-2.0
#include "master/world/world.h"

#include <algorithm>
#include <bit>
#include <type_traits>
#include <utility>

#include "common/units/error.h"
#include "master/behaviour/angle.h"
#include "master/behaviour/perception.h"
#include "master/world/beginning.h"

namespace aquarama {

namespace {

// Chunks depend on the number of fish alone, never on the number of threads.
constexpr std::size_t kFishInChunk = 256;
constexpr float kSpacingMetres = 0.22F;

template <class Value>
std::uint64_t bitsOf(Value value) {
    if constexpr (std::is_same_v<Value, float>)
        return std::bit_cast<std::uint32_t>(value);
    else
        return static_cast<std::uint64_t>(value);
}

// Folds an array into a hash: the multiply-and-shift of splitmix64.
template <class Value>
std::uint64_t folded(std::uint64_t hash, const std::vector<Value>& values) {
    for (const Value value : values) {
        hash = (hash ^ bitsOf(value)) * 0xbf58476d1ce4e5b9U;
        hash ^= hash >> 29U;
    }
    return hash;
}

template <class... Vectors>
std::size_t bytesIn(const Vectors&... vectors) {
    return (... + (vectors.size() * sizeof(vectors[0])));
}

}  // namespace

World::World(const WorldOptions& options, std::shared_ptr<const MotorTables> tables)
    : seed_(options.seed),
      tables_(std::move(tables)),
      gaits_(gaitsOf(*tables_)),
      surroundings_(surroundingsOf(options.seed)),
      traits_(traitsOf(options)),
      grid_(surroundings_.water, kCellMetres, options.fishCount),
      goal_(journeyGoal(options.seed, tick_)),
      schoolRadius_(schoolRadiusMetres(options.fishCount)),
      pool_(options.threads) {
    if (traits_.empty()) throw Error("a world without fish: ask for at least one");
    states_.resize(traits_.size());
    commands_.resize(traits_.size());
    intentions_.resize(traits_.size());
    memory_.resize(traits_.size());
    view_.resize(traits_.size());
    placeSchool(seed_, goal_, surroundings_.water, kSpacingMetres, states_);
    startCommands(gaits_, seed_, commands_, memory_);
    for (std::size_t fish = 0; fish < traits_.size(); ++fish)
        setSpeedBodyLengths(states_, fish, gaits_.speed[indexOf(Action::ForwardMedium)]);
    look(0, traits_.size());
    for (std::size_t fish = 0; fish < traits_.size(); ++fish) {
        intentions_.directionX[fish] = view_.headingX[fish];
        intentions_.directionY[fish] = view_.headingY[fish];
        intentions_.directionZ[fish] = view_.headingZ[fish];
    }
}

template <class Job>
void World::inChunks(const Job& job) {
    const std::size_t fish = traits_.size();
    pool_.run((fish + kFishInChunk - 1) / kFishInChunk, [&](std::size_t chunk) {
        job(chunk * kFishInChunk, std::min(fish, (chunk + 1) * kFishInChunk));
    });
}

void World::advance() {
    goal_ = journeyGoal(seed_, tick_);
    inChunks([this](std::size_t first, std::size_t last) { look(first, last); });
    grid_.rebuild(view_);
    inChunks([this](std::size_t first, std::size_t last) { think(first, last); });
    ++tick_.value;
}

// What all see of fish [first, last).
void World::look(std::size_t first, std::size_t last) {
    for (std::size_t fish = first; fish < last; ++fish) {
        const glm::vec3 position = bodyFrameOf(states_, fish).position;
        const glm::vec3 heading = meanRotation(*tables_, states_, fish) * glm::vec3{1, 0, 0};
        view_.x[fish] = position.x;
        view_.y[fish] = position.y;
        view_.z[fish] = position.z;
        view_.headingX[fish] = heading.x;
        view_.headingY[fish] = heading.y;
        view_.headingZ[fish] = heading.z;
        view_.length[fish] = static_cast<float>(traits_[fish].lengthMillimetres) * 0.001F;
        view_.speed[fish] = speedBodyLengths(states_, fish) * view_.length[fish];
    }
}

void World::think(std::size_t first, std::size_t last) {
    Steering{&view_, &grid_, &surroundings_, goal_, schoolRadius_, seed_, tick_, &intentions_}.run(
        first, last);
    SecondaryController{&gaits_, &view_, &intentions_, &states_, seed_, tick_, &commands_, &memory_}
        .run(first, last);
    MotorStep{tables_.get(), traits_, &commands_, &states_, first, last}.run();
}

std::uint64_t World::hash() const {
    std::uint64_t hash = hashOf(states_);
    hash = folded(hash, commands_.segment);
    hash = folded(hash, commands_.phaseRate);
    hash = folded(hash, commands_.pitch);
    hash = folded(hash, commands_.yawRate);
    hash = folded(hash, commands_.brake);
    for (const auto* values : {&intentions_.directionX,
                               &intentions_.directionY,
                               &intentions_.directionZ,
                               &intentions_.speed,
                               &intentions_.urgency})
        hash = folded(hash, *values);
    hash = folded(hash, memory_.chosenAt);
    hash = folded(hash, memory_.heldUntil);
    return folded(hash, memory_.patience);
}

std::size_t World::bytes() const {
    const MotionStates& s = states_;
    const MotorCommands& c = commands_;
    const Intentions& w = intentions_;
    const SchoolView& v = view_;
    return grid_.bytes() + bytesIn(traits_, memory_.chosenAt, memory_.heldUntil, memory_.patience) +
           bytesIn(s.x, s.y, s.z, s.orientationA, s.orientationB, s.orientationC) +
           bytesIn(s.orientationLargest, s.phase, s.segment, s.fromPhase, s.fromSegment) +
           bytesIn(s.warpFrame, s.warpLength, s.speed) +
           bytesIn(c.segment, c.phaseRate, c.pitch, c.yawRate, c.brake) +
           bytesIn(w.directionX, w.directionY, w.directionZ, w.speed, w.urgency) +
           bytesIn(v.x, v.y, v.z, v.headingX, v.headingY, v.headingZ, v.speed, v.length);
}

void World::records(std::vector<FishRecord>& records) const {
    records.resize(states_.size());
    for (std::size_t fish = 0; fish < states_.size(); ++fish)
        records[fish] = recordOf(states_, fish);
}

}  // namespace aquarama
