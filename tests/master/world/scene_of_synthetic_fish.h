// SPDX-License-Identifier: Apache-2.0
// The scenes of config/scenes with their species' habits and sizes, moved by closed-form segments:
// what fish want is the show's, and nothing has to be captured.
#pragma once

#include <memory>
#include <numbers>
#include <string>

#include "common/config/scene.h"
#include "tests/master/world/school_of_synthetic_fish.h"

namespace aquarama::world {

// About as quick and as agile as the blacktip reef shark.
inline std::shared_ptr<const motion::MotorTables> syntheticShark() {
    static const std::shared_ptr<const motion::MotorTables> tables = [] {
        constexpr double kDegree = std::numbers::pi / 180;
        using synthetic::Gait;
        const auto bend = [](double seconds, double degrees, double stride) {
            return Gait{.periodSeconds = seconds,
                        .turnRadians = degrees * kDegree,
                        .stride = stride,
                        .bends = true};
        };
        const std::array<Gait, motion::kCapturedActions> gaits{
            Gait{.periodSeconds = 1.6, .stride = 0.64},
            Gait{.periodSeconds = 1.1, .stride = 0.66},
            Gait{.periodSeconds = 0.6, .stride = 0.65},
            bend(1.4, 30, 0.6),
            bend(2.0, 58, 0.8),
            bend(1.4, -30, 0.6),
            bend(2.0, -58, 0.8)};
        motion::Repertoire shark = syntheticScad();
        shark.species = "synthetic shark";
        shark.recordedLengthMetres = 1.3F;
        shark.segments = {};
        for (std::size_t action = 0; action < motion::kCapturedActions; ++action)
            shark.segments[action] = synthetic::segmentOf(gaits[action], false);
        motion::addGlide(shark);
        return motion::makeMotorTables(shark);
    }();
    return tables;
}

inline WorldOptions syntheticScene(const std::string& name, std::uint32_t seed = 1) {
    const std::string path = AQUARAMA_SOURCE_DIR "/config/scenes/" + name + ".txtpb";
    WorldOptions options;
    options.seed = seed;
    options.scene = config::readScene(path);
    const std::vector<config::CastSpecies> species = config::readCastSpecies(options.scene, path);
    for (std::size_t i = 0; i < species.size(); ++i) {
        const config::Species& read = species[i].species;
        const auto metres = [](double value) { return static_cast<float>(value); };
        options.cast.push_back({.tables = read.habits.role == config::Role::Predator
                                              ? syntheticShark()
                                              : syntheticTables(),
                                .fish = options.scene.cast[i].fish,
                                .size = {metres(read.size.meanMetres),
                                         metres(read.size.deviationMetres),
                                         metres(read.size.leastMetres),
                                         metres(read.size.mostMetres)},
                                .name = read.name,
                                .habits = read.habits,
                                .start = options.scene.cast[i].start});
    }
    return options;
}

}  // namespace aquarama::world
