// SPDX-License-Identifier: Apache-2.0
#include "master/world/world.h"

#include <algorithm>
#include <bit>
#include <type_traits>
#include <utility>

#include "common/units/error.h"
#include "master/behaviour/angle.h"
#include "master/behaviour/perception.h"
#include "master/behaviour/wandering.h"
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

World::World(const WorldOptions& options)
    : seed_(options.seed),
      surroundings_(surroundingsOf(options.seed)),
      traits_(traitsOf(options)),
      grid_(surroundings_.water, kCellMetres, traits_.size()),
      goal_(journeyGoal(options.seed, tick_)),
      pool_(options.threads) {
    if (traits_.empty()) throw Error("a world without fish: ask for at least one");
    for (const WorldSpecies& species : options.cast) addKind(species);
    schoolRadius_ = schoolRadiusMetres(kinds_.front().last);
    states_.resize(traits_.size());
    commands_.resize(traits_.size());
    intentions_.resize(traits_.size());
    memory_.resize(traits_.size());
    view_.resize(traits_.size());
    begin();
}

void World::addKind(const WorldSpecies& species) {
    const std::size_t first = kinds_.empty() ? 0 : kinds_.back().last;
    const std::size_t last = first + species.fish;
    for (std::size_t at = first; at < last; at += kFishInChunk)
        chunks_.push_back({kinds_.size(), at, std::min(last, at + kFishInChunk)});
    kinds_.push_back({species.tables, gaitsOf(*species.tables), first, last});
}

void World::begin() {
    placeSchool(seed_, goal_, surroundings_.water, kSpacingMetres, kinds_.front().last, states_);
    placeWanderers(seed_, surroundings_.water, kinds_.front().last, states_);
    for (const Kind& kind : kinds_) {
        startCommands(kind.gaits, seed_, kind.first, kind.last, commands_, memory_);
        const float speed = kind.gaits.speed[indexOf(Action::ForwardMedium)];
        for (std::size_t fish = kind.first; fish < kind.last; ++fish)
            setSpeedBodyLengths(states_, fish, speed);
        look(kind, kind.first, kind.last);
    }
    for (std::size_t fish = 0; fish < traits_.size(); ++fish) {
        intentions_.directionX[fish] = view_.headingX[fish];
        intentions_.directionY[fish] = view_.headingY[fish];
        intentions_.directionZ[fish] = view_.headingZ[fish];
    }
}

template <class Job>
void World::inChunks(const Job& job) {
    pool_.run(chunks_.size(), [&](std::size_t i) {
        const Chunk& chunk = chunks_[i];
        job(chunk.kind, chunk.first, chunk.last);
    });
}

void World::advance() {
    goal_ = journeyGoal(seed_, tick_);
    inChunks([this](std::size_t kind, std::size_t first, std::size_t last) {
        look(kinds_[kind], first, last);
    });
    grid_.rebuild(view_);
    inChunks([this](std::size_t kind, std::size_t first, std::size_t last) {
        think(kind, first, last);
    });
    ++tick_.value;
}

// What all see of fish [first, last).
void World::look(const Kind& kind, std::size_t first, std::size_t last) {
    for (std::size_t fish = first; fish < last; ++fish) {
        const glm::vec3 position = bodyFrameOf(states_, fish).position;
        const glm::vec3 heading = meanRotation(*kind.tables, states_, fish) * glm::vec3{1, 0, 0};
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

void World::think(std::size_t kind, std::size_t first, std::size_t last) {
    steer(kind, first, last);
    const Kind& own = kinds_[kind];
    SecondaryController{
        &own.gaits, &view_, &intentions_, &states_, seed_, tick_, &commands_, &memory_}
        .run(first, last);
    MotorStep{own.tables.get(), traits_, &commands_, &states_, first, last}.run();
}

void World::steer(std::size_t kind, std::size_t first, std::size_t last) {
    if (kind == 0) {
        const std::size_t schoolmates = kinds_.front().last;
        Steering{&view_,
                 &grid_,
                 &surroundings_,
                 schoolmates,
                 goal_,
                 schoolRadius_,
                 seed_,
                 tick_,
                 &intentions_}
            .run(first, last);
    } else {
        const float cruise = kinds_[kind].gaits.speed[indexOf(Action::ForwardSlow)];
        Wandering{&view_, &grid_, &surroundings_, cruise, seed_, tick_, &intentions_}.run(first,
                                                                                          last);
    }
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
