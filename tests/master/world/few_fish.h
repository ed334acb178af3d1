// SPDX-License-Identifier: Apache-2.0
// Worlds for tests of appetite: one or two species in open water, moved by closed-form segments.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>

#include "tests/master/world/school_of_synthetic_fish.h"

namespace aquarama::world {

// As quick and as wide in its turns as the blacktip reef shark.
inline std::shared_ptr<const motion::MotorTables> sharkTables() {
    static const std::shared_ptr<const motion::MotorTables> tables = [] {
        constexpr double kDegree = std::numbers::pi / 180;
        using synthetic::Gait;
        const Gait gradual{
            .periodSeconds = 2.13, .turnRadians = 31 * kDegree, .stride = 1.1, .bends = true};
        const Gait sharp{
            .periodSeconds = 2.67, .turnRadians = 59 * kDegree, .stride = 1.16, .bends = true};
        const auto right = [](Gait gait) {
            gait.turnRadians = -gait.turnRadians;
            return gait;
        };
        const std::array<Gait, motion::kCapturedActions> gaits{
            Gait{.periodSeconds = 1.6, .stride = 0.65},
            Gait{.periodSeconds = 1.07, .stride = 0.60},
            Gait{.periodSeconds = 0.73, .stride = 0.53},
            gradual,
            sharp,
            right(gradual),
            right(sharp)};
        motion::Repertoire shark{
            .species = "synthetic shark",
            .recordedLengthMetres = 1.3F,
            .response = {.swimDrag = {0.3F, 0.3F, 0.3F}, .glideDrag = 0.09F, .brakeRate = 0.9F},
            .segments = {}};
        for (std::size_t action = 0; action < motion::kCapturedActions; ++action)
            shark.segments[action] = synthetic::segmentOf(gaits[action], false);
        motion::addGlide(shark);
        return motion::makeMotorTables(shark);
    }();
    return tables;
}

inline WorldSpecies scads(std::uint32_t fish) {
    WorldSpecies scads{.tables = syntheticTables(), .fish = fish};
    scads.name = "synthetic scad";
    scads.habits.shares.schooling = 1;
    return scads;
}

inline WorldSpecies sharks(std::uint32_t fish) {
    WorldSpecies sharks{
        .tables = sharkTables(),
        .fish = fish,
        .size = {
            .meanMetres = 1.3F, .deviationMetres = 0, .leastMetres = 1.3F, .mostMetres = 1.3F}};
    sharks.name = "synthetic shark";
    config::Habits& habits = sharks.habits;
    habits.role = config::Role::Predator;
    habits.eatsPlankton = false;
    habits.digestionPerSecond = 0.002F;
    habits.shares = {};
    habits.hunts = {"synthetic scad"};
    habits.visionBodyLengths = 10;
    habits.box = {1.5F, 0.5F, 0.4F};
    habits.persistence = 0.7F;
    return sharks;
}

// Of about 0.24 m; half of them females; always fed.
inline WorldSpecies pacifists(std::uint32_t fish) {
    WorldSpecies pacifists{.tables = syntheticTables(), .fish = fish};
    pacifists.name = "synthetic tang";
    config::Habits& habits = pacifists.habits;
    habits.role = config::Role::Pacifist;
    habits.libidoPerSecond = 0.004F;
    return pacifists;
}

inline WorldOptions openWater(std::uint32_t seed, std::vector<WorldSpecies> cast) {
    WorldOptions options;
    options.seed = seed;
    options.scene.gathering = config::Gathering::None;
    options.scene.plankton = 0;
    options.scene.eye = {0, -6, 30};
    options.cast = std::move(cast);
    return options;
}

}  // namespace aquarama::world
