// SPDX-License-Identifier: Apache-2.0
// Worlds for tests, with the species of config/species moved by their captured repertoires. These
// come from the cache, or are captured once and kept there, as in a show.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "capture/repertoire_files.h"
#include "common/base/files.h"
#include "common/config/scene.h"
#include "common/config/species.h"
#include "common/motion/motor.h"
#include "master/world/world.h"
#include "tests/support/cast.h"

namespace aquarama::world {

inline const motion::Repertoire& capturedRepertoire(const std::string& species) {
    static std::map<std::string, motion::Repertoire> all;
    if (!all.contains(species)) {
        const capture::RepertoireFile file =
            capture::repertoiresFor(
                {test::castMember(species)}, capture::repertoireFolders(), capture::CaptureRun{})
                .front();
        all.emplace(species, motion::decodeRepertoire(file.bytes, species));
    }
    return all.at(species);
}

inline std::shared_ptr<const motion::MotorTables> capturedTables(const std::string& species) {
    static std::map<std::string, std::shared_ptr<const motion::MotorTables>> all;
    auto& tables = all[species];
    if (!tables) tables = motion::makeMotorTables(capturedRepertoire(species));
    return tables;
}

// With the sizes and habits of its file.
inline WorldSpecies capturedSpecies(const config::Species& read, std::uint32_t fish) {
    const auto metres = [](double value) { return static_cast<float>(value); };
    return {.tables = capturedTables(read.name),
            .fish = fish,
            .size = {metres(read.size.meanMetres),
                     metres(read.size.deviationMetres),
                     metres(read.size.leastMetres),
                     metres(read.size.mostMetres)},
            .name = read.name,
            .habits = read.habits};
}

// Scads that do nothing but school.
inline WorldOptions optionsOfSchool(std::uint32_t seed, std::uint32_t fish, unsigned threads = 1) {
    WorldOptions options;
    options.seed = seed;
    options.threads = threads;
    WorldSpecies school{.tables = capturedTables("bigeye_scad"), .fish = fish};
    school.name = "bigeye_scad";
    school.habits.shares.schooling = 1;
    options.cast = {school};
    return options;
}

inline World schoolWorld(std::uint32_t seed, std::uint32_t fish, unsigned threads = 1) {
    return World(optionsOfSchool(seed, fish, threads));
}

// A scene of config/scenes as it is shown.
inline WorldOptions optionsOfScene(const std::string& name, std::uint32_t seed = 1) {
    const std::string path = AQUARAMA_SOURCE_DIR "/config/scenes/" + name + ".txtpb";
    WorldOptions options;
    options.seed = seed;
    options.scene = config::readScene(path);
    const std::vector<config::CastSpecies> species = config::readCastSpecies(options.scene, path);
    for (std::size_t i = 0; i < species.size(); ++i) {
        options.cast.push_back(capturedSpecies(species[i].species, options.scene.cast[i].fish));
        options.cast.back().start = options.scene.cast[i].start;
        options.cast.back().homes = options.scene.cast[i].homes;
    }
    return options;
}

}  // namespace aquarama::world
