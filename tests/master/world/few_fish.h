// SPDX-License-Identifier: Apache-2.0
// Worlds for tests of appetite: one or two species in open water, moved by captured segments.
#pragma once

#include <cstdint>

#include "tests/master/world/captured_fish.h"

namespace aquarama::world {

inline WorldSpecies scads(std::uint32_t fish) {
    WorldSpecies scads{.tables = capturedTables("bigeye_scad"), .fish = fish};
    scads.name = "bigeye_scad";
    scads.habits.shares.schooling = 1;
    return scads;
}

inline WorldSpecies sharks(std::uint32_t fish) {
    WorldSpecies sharks{
        .tables = capturedTables("blacktip_reef_shark"),
        .fish = fish,
        .size = {
            .meanMetres = 1.3F, .deviationMetres = 0, .leastMetres = 1.3F, .mostMetres = 1.3F}};
    sharks.name = "blacktip_reef_shark";
    config::Habits& habits = sharks.habits;
    habits.role = config::Role::Predator;
    habits.hunger.eatsPlankton = false;
    habits.hunger.digestionPerSecond = 0.002F;
    habits.shares = {};
    habits.hunts = {"bigeye_scad"};
    habits.visionBodyLengths = 10;
    habits.box = {1.5F, 0.5F, 0.4F};
    habits.persistence = 0.7F;
    return sharks;
}

// Of about 0.24 m; half of them females; always fed.
inline WorldSpecies pacifists(std::uint32_t fish) {
    WorldSpecies pacifists{.tables = capturedTables("blue_tang"), .fish = fish};
    pacifists.name = "blue_tang";
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
