// SPDX-License-Identifier: Apache-2.0
// Food in the water: plankton that drifts, and pellets that visitors drop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/place/obstacles.h"

namespace aquarama::surroundings {

// None: the element is free at present.
enum class FoodKind : std::uint8_t { None, Plankton, Pellet };

// All particles of a world as a structure of arrays. Plankton comes first, then kMostPellets
// elements for pellets. The index of a particle is its name while it exists. Owned by the world;
// changed by one thread at a time.
struct Food {
    std::vector<float> x, y, z;  // metres
    // Height y below which it does not sink, metres.
    std::vector<float> lowest;
    // None: eaten, dissolved, or not there yet.
    std::vector<FoodKind> kind;
    // 1 while it is drawn into a mouth: no other fish can take it.
    std::vector<std::uint8_t> taken;
    // Counts up when a new particle takes the element, so that viewers do not interpolate between
    // the two.
    std::vector<std::uint8_t> generation;
    // Low 32 bits of a tick. A free element of plankton is filled again at it; a pellet dissolves
    // at it.
    std::vector<std::uint32_t> absentUntil;
    // Number of pellets in the water.
    std::uint32_t pellets = 0;

    // Number of particles, and the position and presence of particle i.
    [[nodiscard]] std::size_t size() const { return x.size(); }
    [[nodiscard]] glm::vec3 position(std::size_t i) const { return {x[i], y[i], z[i]}; }
    [[nodiscard]] bool isThere(std::size_t i) const { return kind[i] != FoodKind::None; }
    // Whether a fish may pursue the particle: no fish has it, and it does not lie so near to the
    // sand that a fish would turn back before it.
    [[nodiscard]] bool isFree(std::size_t i) const {
        return isThere(i) && taken[i] == 0 &&
               (kind[i] == FoodKind::Plankton || y[i] > lowest[i] + kOutOfReachMetres);
    }
    // Height over the sand up to which a pellet is out of reach.
    static constexpr float kOutOfReachMetres = 0.4F;
};

// Largest number of pellets in the water at a time; more are not dropped.
inline constexpr std::size_t kMostPellets = 256;

// Makes `plankton` particles at random places that fish can reach, and room for pellets. Functions
// below use only the seed, the tick and the particle as sources of chance.
[[nodiscard]] Food makeFood(std::uint32_t seed,
                            const place::Obstacles& obstacles,
                            std::uint32_t plankton);
// Advances all particles by one tick: plankton drifts with the swell and with the current, whose
// velocity far from boulders is `open`, metres a second; pellets sink. What the current carries out
// of the water comes in again up-current; what was eaten appears again elsewhere after a while.
// O(particles); allocates nothing.
void driftFood(
    Food& food, std::uint32_t seed, const place::Obstacles& obstacles, glm::vec3 open, Tick tick);
// Moves all that is noted by its tick back by so many ticks.
void shiftTime(Food& food, std::uint64_t ticks);
// Drops pellets around a point, as many as there is room for. They sink, lie on the sand for 20 s
// and dissolve.
void dropPellets(Food& food,
                 std::uint32_t seed,
                 const place::Obstacles& obstacles,
                 glm::vec3 position,
                 std::uint32_t pellets,
                 Tick tick);
// Reserves a particle for one fish. False where another fish has it or it is gone.
bool takeFood(Food& food, std::uint32_t particle);
// Removes a particle that was swallowed; it stays absent for 20 to 40 s.
void removeFood(Food& food, std::uint32_t particle, Tick tick);

// Velocity at which the swell alone moves plankton at a place, metres a second: slow, and dying
// away towards the borders. No libm, so that all machines agree.
[[nodiscard]] glm::vec3 swellAt(const place::Region& water, glm::vec3 position, Tick tick);

}  // namespace aquarama::surroundings
