// SPDX-License-Identifier: Apache-2.0
#include "common/school/school_motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <thread>
#include <utility>

#include "common/motion/motor_tables.h"
#include "common/place/contact.h"

namespace aquarama::school {
namespace {

using motion::Action;

// Half the width of a body, as a share of its length.
constexpr float kHalfWidth = 0.06F;
constexpr float kUnitsATick =
    1 / (motion::kPositionUnitMetres * static_cast<float>(kTicksPerSecond));
constexpr std::size_t kFishInChunk = 512;
// What carries a fish is prefetched so many fish ahead.
constexpr std::size_t kFetchedAhead = 6;
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

// A fish of a school that nobody leads.
struct Lone {
    const motion::MotorTables& tables;
    const place::Obstacles& obstacles;
    float lengthMetres;
    SchoolState& school;
    std::size_t fish;

    [[nodiscard]] Action commanded() const {
        return static_cast<Action>(school.commands.action[fish]);
    }
    void command(Action action) {
        if (action == commanded()) return;
        school.commands.action[fish] = static_cast<std::uint8_t>(action);
        school.commands.phaseRate[fish] = motion::recordedPhaseRate(tables, action);
    }
    // What it lacks to the pitch that it is to have, as sines.
    [[nodiscard]] float pitchError() const {
        const glm::vec3 nose =
            motion::meanRotation(tables, school.states, fish) * glm::vec3{1, 0, 0};
        return static_cast<float>(school.commands.pitch[fish]) * motion::kPitchUnit - nose.y;
    }
    // Not where the slope would overshoot before it is ended.
    [[nodiscard]] bool takesSlope(Action gait, float error) const {
        const float rate = motion::recordedPitchRate(tables, motion::slopeOf(gait, true));
        return std::abs(error) > kSecondsToEnd * std::abs(rate);
    }
    void goOnward() {
        const Action present = commanded();
        if (motion::isPitch(present) || motion::isPivot(present) || present == Action::Retreat)
            return command(Action::Hover);
        if (motion::isTurn(present) || motion::isStart(present))
            return command(motion::gaitOf(present));
        if (motion::isForward(present) || motion::isSlope(present)) command(levelled(present));
    }
    // The slope to the pitch that it is to have, or its gait once it has it.
    [[nodiscard]] Action levelled(Action present) const {
        const Action gait = motion::gaitOf(present);
        const float error = pitchError();
        return takesSlope(gait, error) ? motion::slopeOf(gait, error > 0) : gait;
    }
    // The turn of a circle is that of its curve, and what fins add where that is too wide.
    [[nodiscard]] float speed() const {
        return lengthMetres * motion::recordedSpeedBodyLengths(tables, Action::CurveLeftWideSlow);
    }
    [[nodiscard]] float turnRate(Action curve) const {
        return motion::recordedTurnRate(tables, motion::firstSegmentOf(curve));
    }
    [[nodiscard]] float radius(Action curve) const {
        return std::min(speed() / std::max(std::abs(turnRate(curve)), kLeastTurnRate),
                        kWidestMetres);
    }
    // Of places on the circle that it swims by this curve, how many have no room for it.
    [[nodiscard]] int obstructed(Action curve) const {
        constexpr int kPlaces = 16;
        const motion::BodyFrame body = motion::bodyFrameOf(school.states, fish);
        const glm::vec3 nose = body.rotation * glm::vec3{1, 0, 0};
        const glm::vec3 ahead = glm::normalize(glm::vec3{nose.x, 0, nose.z});
        const glm::vec3 left{ahead.z, 0, -ahead.x};
        const float wide = radius(curve);
        const float side = curve == Action::CurveLeftWideSlow ? wide : -wide;
        int count = 0;
        for (int place = 1; place < kPlaces; ++place) {
            const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(place) / kPlaces;
            const glm::vec3 at = body.position + wide * std::sin(angle) * ahead +
                                 side * (1 - std::cos(angle)) * left;
            if (place::contactVelocity(obstacles, at, lengthMetres) != glm::vec3{}) ++count;
        }
        return count;
    }
    void circle() {
        motion::MotorCommands& commands = school.commands;
        commands.brake[fish] = commands.mouth[fish] = 0;
        commands.pitch[fish] = commands.yawRate[fish] = 0;
        const Action present = commanded();
        if (motion::staysInPlace(present)) return command(Action::Hover);
        const Action level = levelled(Action::ForwardSlow);
        if (motion::isSlope(level)) return command(level);
        const Action curve = circling(present);
        command(curve);
        const float lacks = speed() / radius(curve) - std::abs(turnRate(curve));
        const float added = std::max(lacks, 0.0F) / static_cast<float>(kTicksPerSecond);
        commands.yawRate[fish] = static_cast<std::int16_t>(
            motion::roundToEven((turnRate(curve) > 0 ? added : -added) / motion::kYawUnit));
    }
    // The curve that it is on already, or that with more room.
    [[nodiscard]] Action circling(Action present) const {
        using enum Action;
        if (present == CurveLeftWideSlow || present == CurveRightWideSlow) return present;
        return obstructed(CurveLeftWideSlow) <= obstructed(CurveRightWideSlow) ? CurveLeftWideSlow
                                                                               : CurveRightWideSlow;
    }

    static constexpr float kSecondsToEnd = 0.4F;    // a slope: a command, and its warp
    static constexpr float kLeastTurnRate = 0.01F;  // radians a second
    static constexpr float kWidestMetres = 2.5F;    // a circle, its radius
};

}  // namespace

void Carrier::carry(std::span<const motion::FishTraits> traits,
                    const motion::MotionStates& states,
                    std::size_t first,
                    std::size_t last,
                    motion::Advection& advection) const {
    for (std::size_t fish = first; fish < last; ++fish) {
        if (fish + kFetchedAhead < last) {
            const glm::vec3 next = positionOf(states, fish + kFetchedAhead);
            current->fetch(next);
            obstacles->chart.fetch({next.x, next.z});
        }
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

void SchoolMotion::command(SchoolState& school, Alone way) const {
    for (const Swimmers& own : chunks_) {
        for (std::size_t fish = own.first; fish < own.last; ++fish) {
            if (motion::isAway(school.states, fish)) continue;
            const float length = static_cast<float>(traits_[fish].lengthMillimetres) * 0.001F;
            Lone one{*own.tables, obstacles_, length, school, fish};
            way == Alone::InCircles ? one.circle() : one.goOnward();
        }
    }
}

}  // namespace aquarama::school
