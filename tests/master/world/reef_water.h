// SPDX-License-Identifier: Apache-2.0
// Worlds for tests of life at a reef: the water of a show with two heads before the eye.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "tests/master/world/captured_fish.h"

namespace aquarama::world {

// In plan, metres.
inline constexpr glm::vec2 kLeftHead{-2.4F, -2.9F};
inline constexpr glm::vec2 kRightHead{2.6F, -2.9F};

// A reef without plankton, at noon that stays.
inline WorldOptions reefWater(std::uint32_t seed,
                              std::vector<config::SiteGroup> sites,
                              std::vector<WorldSpecies> cast) {
    WorldOptions options;
    options.seed = seed;
    config::Scene& scene = options.scene;
    scene.water.centre = {0, -5.75F, -3.6F};
    scene.water.halfExtent = {7.4F, 2.45F, 6.1F};
    scene.plankton = 0;
    for (const glm::vec2 xz : {kLeftHead, kRightHead})
        scene.heads.push_back({.xz = xz, .radiusMetres = 0.8F, .heightMetres = 1.7F});
    scene.sites = std::move(sites);
    scene.current = {.tideMetresPerSecond = 0.12, .surgeMetresPerSecond = 0.05};
    options.cast = std::move(cast);
    return options;
}

// Clownfish that live in a cloud over a head, and that fish hunt under this name.
inline WorldSpecies cloudOver(glm::vec2 head, const std::string& name, std::uint32_t fish) {
    WorldSpecies cloud = capturedSpecies(test::castMember("clownfish"), fish);
    cloud.name = name;
    cloud.habits.role = config::Role::Prey;
    cloud.habits.libidoPerSecond = 0;
    cloud.habits.visionBodyLengths = cloud.habits.smellBodyLengths = 40;
    cloud.habits.home = {.kind = config::HomeKind::Place,
                         .radiusMetres = 0.8,
                         .leashMetres = 2,
                         .onTheReef = true,
                         .site = config::SiteKind::Branching,
                         .group = fish};
    cloud.habits.cloud = config::Cloud{.heightMetres = 1.2, .pickSeconds = 2.6};
    cloud.habits.hidesIn = {config::SiteKind::Branching};
    cloud.homes = {head};
    return cloud;
}

}  // namespace aquarama::world
