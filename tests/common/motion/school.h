// SPDX-License-Identifier: Apache-2.0
// A school of synthetic fish to step in tests, and what to ask of it.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include <glm/gtc/quaternion.hpp>

#include "common/base/units.h"
#include "common/motion/motor.h"
#include "tests/support/synthetic_repertoire.h"

namespace aquarama::motion {

inline const Repertoire& sharedRepertoire() {
    static const Repertoire kRepertoire = test::syntheticRepertoire(true);
    return kRepertoire;
}

inline const MotorTables& sharedTables() {
    static const auto kTables = makeMotorTables(sharedRepertoire());
    return *kTables;
}

struct School {
    MotionStates states;
    MotorCommands commands;
    std::vector<FishTraits> traits;
    const MotorTables* tables;

    explicit School(std::size_t fish, const MotorTables& motorTables = sharedTables())
        : traits(fish, {.id = 0, .lengthMillimetres = 200}), tables(&motorTables) {
        states.resize(fish);
        commands.resize(fish);
        for (std::size_t i = 0; i < fish; ++i) setBodyFrame(states, i, {});
    }

    // As recorded, from now on and for long.
    void play(std::size_t fish, Action action) {
        states.segment[fish] = firstSegmentOf(action);
        command(fish, action);
        setSpeedBodyLengths(states, fish, recordedSpeedBodyLengths(*tables, action));
    }
    void playAtRate(std::size_t fish, Action action, int phaseRate) {
        play(fish, action);
        const double share = 1.0 * phaseRate / commands.phaseRate[fish];
        commands.phaseRate[fish] = static_cast<std::int16_t>(phaseRate);
        setSpeedBodyLengths(
            states, fish, static_cast<float>(share) * speedBodyLengths(states, fish));
    }
    void command(std::size_t fish, Action action) {
        commands.action[fish] = static_cast<std::uint8_t>(action);
        commands.phaseRate[fish] = recordedPhaseRate(*tables, action);
    }

    [[nodiscard]] MotorStep step() {
        return {.tables = tables,
                .traits = traits,
                .commands = &commands,
                .states = &states,
                .first = 0,
                .last = traits.size()};
    }
    void tick(int ticks = 1) {
        for (int i = 0; i < ticks; ++i) step().run();
    }

    [[nodiscard]] glm::dvec3 place(std::size_t fish) const {
        return glm::dvec3(states.x[fish], states.y[fish], states.z[fish]) / 65536.0;
    }
    [[nodiscard]] glm::dquat mean(std::size_t fish) const {
        return glm::dquat(meanRotation(*tables, states, fish));
    }
    // Degrees: of the mean frame; heading left positive, pitch up positive.
    [[nodiscard]] double heading(std::size_t fish) const {
        const glm::dvec3 nose = mean(fish) * glm::dvec3(1, 0, 0);
        return std::atan2(-nose.z, nose.x) / kDegree;
    }
    [[nodiscard]] double pitch(std::size_t fish) const {
        return std::asin((mean(fish) * glm::dvec3(1, 0, 0)).y) / kDegree;
    }
    [[nodiscard]] double roll(std::size_t fish) const {
        const glm::dquat q = mean(fish);
        return std::atan2((q * glm::dvec3(0, 0, 1)).y, (q * glm::dvec3(0, 1, 0)).y) / kDegree;
    }
};

inline glm::quat aboutAxis(double degrees, const glm::vec3& axis) {
    return glm::angleAxis(static_cast<float>(degrees * kDegree), axis);
}

// Every fish of the school in some state and with some command, all of them possible.
inline void scatter(School& school, std::mt19937& random) {
    std::normal_distribution<float> normal;
    for (std::size_t i = 0; i < school.traits.size(); ++i) {
        const glm::quat turn(normal(random), normal(random), normal(random), normal(random));
        const glm::vec3 place(normal(random), normal(random), normal(random));
        setBodyFrame(school.states, i, {100.0F * place, glm::normalize(turn)});
        school.states.segment[i] = static_cast<std::uint8_t>(random() % kSegments);
        school.states.phase[i] = static_cast<std::uint16_t>(random());
        school.states.speed[i] = static_cast<std::int32_t>(random() % 4000000) - 2000000;
        school.traits[i].lengthMillimetres = static_cast<std::uint16_t>(20 + random() % 5000);
    }
}

inline void commandAtRandom(School& school, std::mt19937& random) {
    for (std::size_t i = 0; i < school.traits.size(); ++i) {
        if (random() % 20 != 0) continue;  // a decision every third of a second
        school.commands.action[i] = static_cast<std::uint8_t>(random() % kActions);
        school.commands.phaseRate[i] = static_cast<std::int16_t>(random() % 6000);
        school.commands.brake[i] = static_cast<std::uint8_t>(random() % 2 == 0 ? 0 : random());
        school.commands.pitch[i] = static_cast<std::int16_t>(random());
        school.commands.yawRate[i] = static_cast<std::int16_t>(random());
    }
}

}  // namespace aquarama::motion
