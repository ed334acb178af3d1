// SPDX-License-Identifier: Apache-2.0
// Worlds for tests: the school as on the wall, moved by closed-form segments that are as quick and
// as agile as the bigeye scad's.
#pragma once

#include <array>
#include <memory>
#include <numbers>

#include "common/motion/motor.h"
#include "master/world/world.h"
#include "tests/support/synthetic_repertoire.h"

namespace aquarama::world {

inline motion::Repertoire syntheticScad() {
    constexpr double kDegree = std::numbers::pi / 180;
    using synthetic::Gait;
    const Gait gradual{
        .periodSeconds = 0.7, .turnRadians = 30 * kDegree, .stride = 1.15, .bends = true};
    const Gait sharp{
        .periodSeconds = 1.0, .turnRadians = 55 * kDegree, .stride = 1.5, .bends = true};
    const auto right = [](Gait gait) {
        gait.turnRadians = -gait.turnRadians;
        return gait;
    };
    const std::array<Gait, motion::kCapturedActions> gaits{
        Gait{.periodSeconds = 1.0 / 2, .stride = 0.50},
        Gait{.periodSeconds = 1.0 / 3, .stride = 0.65},
        Gait{.periodSeconds = 1.0 / 5, .stride = 0.52},
        gradual,
        sharp,
        right(gradual),
        right(sharp)};
    motion::Repertoire scad{
        .species = "synthetic scad",
        .recordedLengthMetres = 0.24F,
        .response = {.swimDrag = {1.0F, 1.0F, 1.0F}, .glideDrag = 0.4F, .brakeRate = 4.0F},
        .segments = {}};
    for (std::size_t action = 0; action < motion::kCapturedActions; ++action)
        scad.segments[action] = synthetic::segmentOf(gaits[action], false);
    motion::addGlide(scad);
    return scad;
}

inline std::shared_ptr<const motion::MotorTables> syntheticTables() {
    static const std::shared_ptr<const motion::MotorTables> tables =
        motion::makeMotorTables(syntheticScad());
    return tables;
}

inline WorldOptions optionsOfSchool(std::uint32_t seed, std::uint32_t fish, unsigned threads = 1) {
    WorldOptions options;
    options.seed = seed;
    options.threads = threads;
    WorldSpecies school{.tables = syntheticTables(), .fish = fish};
    school.name = "synthetic scad";
    school.habits.shares.schooling = 1;
    options.cast = {school};
    return options;
}

inline World syntheticWorld(std::uint32_t seed, std::uint32_t fish, unsigned threads = 1) {
    return World(optionsOfSchool(seed, fish, threads));
}

}  // namespace aquarama::world
