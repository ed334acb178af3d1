// SPDX-License-Identifier: Apache-2.0
// The turf of a reef: patches of algae on boulders, which fish bite off and which grow again. World
// frame, metres.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/place/obstacles.h"
#include "common/place/sites.h"

namespace aquarama::surroundings {

// Places at which fish bite, on and about a patch.
inline constexpr std::size_t kSpots = 12;

// One patch: a turf site within reach of the fish. Constant.
struct TurfPatch {
    glm::vec3 place{};          // on the boulder
    glm::vec3 normal{0, 1, 0};  // unit vector
    glm::vec3 boulder{};        // its middle
    float surfaceMetres = 1;    // from there to its surface
    std::array<glm::vec3, kSpots> spots{};
};

// All patches and how much grows on each: 0 to kFull. Owned by the world; the index of a patch is
// its name.
struct Turf {
    std::vector<TurfPatch> patches;
    std::vector<std::uint16_t> fill;

    // 200 s regrow an empty patch: one unit a tick. 150 bites empty a full one.
    static constexpr std::uint16_t kFull = 12'000;
    static constexpr std::uint16_t kOfABite = kFull / 150;
    // 0 to 1.
    [[nodiscard]] float shareOf(std::size_t patch) const {
        return static_cast<float>(fill[patch]) / float{kFull};
    }
};

// The turf sites that fish reach, in their order: on a boulder in the water, away from its borders.
// How full each is at tick 0 is drawn by the seed, from half to wholly.
[[nodiscard]] Turf makeTurf(std::uint32_t seed,
                            const std::vector<place::Site>& sites,
                            const place::Obstacles& obstacles);
// Grows all patches for one tick.
void growTurf(Turf& turf);
// Takes a bite from a patch. False where too little is left.
bool biteTurf(Turf& turf, std::uint32_t patch);

}  // namespace aquarama::surroundings
