// SPDX-License-Identifier: Apache-2.0
#include "common/school/school_motion.h"

#include <algorithm>
#include <cassert>
#include <thread>
#include <utility>

#include "common/place/contact.h"

namespace aquarama::school {
namespace {

// Half the width of a body, as a share of its length.
constexpr float kHalfWidth = 0.06F;
constexpr float kUnitsATick =
    1 / (motion::kPositionUnitMetres * static_cast<float>(kTicksPerSecond));
constexpr std::size_t kFishInChunk = 512;
// With fewer each thread would mostly wait for the others.
constexpr std::size_t kFishOfAThread = 4000;

unsigned threadsFor(std::size_t fish) {
    const auto most = static_cast<std::size_t>(std::max(std::thread::hardware_concurrency(), 1U));
    return static_cast<unsigned>(std::clamp<std::size_t>(fish / kFishOfAThread, 1, most));
}

std::int32_t unitsOf(float metresPerSecond) {
    return static_cast<std::int32_t>(motion::roundToEven(metresPerSecond * kUnitsATick));
}

glm::vec3 positionOf(const motion::MotionStates& states, std::size_t fish) {
    return {static_cast<float>(states.x[fish]) * motion::kPositionUnitMetres,
            static_cast<float>(states.y[fish]) * motion::kPositionUnitMetres,
            static_cast<float>(states.z[fish]) * motion::kPositionUnitMetres};
}

}  // namespace

void Carrier::carry(std::span<const motion::FishTraits> traits,
                    const motion::MotionStates& states,
                    std::size_t first,
                    std::size_t last,
                    motion::Advection& advection) const {
    for (std::size_t fish = first; fish < last; ++fish) {
        glm::vec3 velocity{};
        if (!motion::isAway(states, fish)) {
            const glm::vec3 position = positionOf(states, fish);
            const float length = static_cast<float>(traits[fish].lengthMillimetres) * 0.001F;
            velocity = current->at(position, open) +
                       place::contactVelocity(*obstacles, position, kHalfWidth * length);
        }
        advection.x[fish] = unitsOf(velocity.x);
        advection.y[fish] = unitsOf(velocity.y);
        advection.z[fish] = unitsOf(velocity.z);
    }
}

SchoolMotion::SchoolMotion(std::vector<Swimmers> swimmers,
                           std::vector<motion::FishTraits> traits,
                           place::Obstacles obstacles,
                           const config::SceneCurrent& current)
    : traits_(std::move(traits)),
      obstacles_(std::move(obstacles)),
      current_(current, obstacles_.rocks, obstacles_.water),
      pool_(threadsFor(traits_.size())) {
    for (const Swimmers& kind : swimmers) {
        assert(kind.last <= traits_.size());
        for (std::size_t at = kind.first; at < kind.last; at += kFishInChunk)
            chunks_.push_back({kind.tables, at, std::min(kind.last, at + kFishInChunk)});
    }
    for (auto* column : {&advection_.x, &advection_.y, &advection_.z})
        column->resize(traits_.size());
}

void SchoolMotion::advance(SchoolState& school) {
    assert(school.size() == traits_.size());
    const Carrier carrier{
        &obstacles_, &current_, current_.open(static_cast<std::int64_t>(school.tick.value))};
    pool_.run(chunks_.size(), [&](std::size_t chunk) {
        const Swimmers& own = chunks_[chunk];
        carrier.carry(traits_, school.states, own.first, own.last, advection_);
        motion::MotorStep{own.tables.get(),
                          traits_,
                          &school.commands,
                          &school.states,
                          own.first,
                          own.last,
                          &advection_}
            .run();
    });
    ++school.tick.value;
}

}  // namespace aquarama::school
