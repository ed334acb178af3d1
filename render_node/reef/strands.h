// SPDX-License-Identifier: Apache-2.0
// Noise and random numbers for what is only drawn, and the building blocks of corals and plants.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/base/hash.h"
#include "render_node/reef/mesh.h"

namespace aquarama::scene {

// Value noise, -1 to 1, with one lattice cell for each unit of `place`.
[[nodiscard]] float solidNoise(std::uint32_t seed, glm::vec3 place);
// Sum of octaves of solidNoise(), about -1 to 1.
[[nodiscard]] float billows(std::uint32_t seed, glm::vec3 place, int octaves);
// The same with sharp crests at +1.
[[nodiscard]] float ridges(std::uint32_t seed, glm::vec3 place, int octaves);

// How much of a noise a mesh can show that has so many vertices for each of its cells, 0 to 1. With
// fewer the noise would only make corners.
[[nodiscard]] float resolvedShare(float verticesACell);

// A stream of random numbers: the n-th is a hash of seed and n, the same on every machine. Copies
// continue independently.
class Dice {
  public:
    explicit Dice(std::uint32_t seed) : seed_{seed} {}
    // 0 to 1.
    float unit() { return unitOf(hashOf(seed_, count_++)); }
    float between(float low, float high) { return low + (high - low) * unit(); }
    // A seed for another stream.
    std::uint32_t seed() { return hashOf(seed_, count_++); }

  private:
    std::uint32_t seed_;
    std::uint32_t count_ = 0;
};

// A right-handed frame, columns x, y, z, with y along `up` and turned about it by so many radians.
// up: unit vector.
[[nodiscard]] glm::mat3 frameAbout(glm::vec3 up, float turnRadians);

// Tubes, ribbons, leaves and bodies of revolution. Each function appends to the mesh.

// A point of a strand's axis, with radius (half the width of a ribbon), material and ambient
// occlusion there.
struct Joint {
    glm::vec3 centre{};
    float radius = 0.0F;
    Surface surface{};
    float ambientOcclusion = 1.0F;
};
// A tube through the joints, with so many sides; 0 sides: a flat ribbon that faces `facing`. At
// least two joints, whose places differ.
void addStrand(Mesh& mesh, std::span<const Joint> joints, int sides, glm::vec3 facing = {0, 0, 1});

// How a leaf differs from a ribbon: the direction `side` of its width (unit vector), and a ruffle
// of its edges, as a share of its width, with so many radians of waves along it. A ruffled leaf is
// folded at its midrib.
struct Leaf {
    glm::vec3 side{};
    float ruffle = 0.0F;
    float waves = 0.0F;
    float phase = 0.0F;
};
// A leaf along the joints, at least two.
void addLeaf(Mesh& mesh, std::span<const Joint> joints, const Leaf& leaf);

// A body of revolution about an axis, from foot to crown, made irregular by noise.
// One ring of its outline: radius and height along the axis, ambient occlusion.
struct Ring {
    float radius = 0.0F;
    float height = 0.0F;
    float ambientOcclusion = 1.0F;
    // Factor of the albedo.
    float shade = 1.0F;
    // Share of the irregularity that the ring takes.
    float waver = 1.0F;
};
// The first ring of an outline, the third and so on, for coarse levels. The number of rings is odd,
// so that the last one remains.
template <std::size_t Rings>
[[nodiscard]] constexpr std::array<Ring, Rings / 2 + 1> everySecond(
    const std::array<Ring, Rings>& rings) {
    static_assert(Rings % 2 == 1);
    std::array<Ring, Rings / 2 + 1> kept{};
    for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = rings[2 * i];
    return kept;
}
// The axis, the number of segments around it, and the irregularity.
struct Turning {
    glm::vec3 centre{};
    glm::vec3 up{0, 1, 0};
    int around = 12;
    std::uint32_t seed = 0;
    // Irregularity of the radius, relative to it.
    float wide = 0.0F;
    // Irregularity of the height, in the units of the mesh.
    float high = 0.0F;
    // Noise cells over a radius of the unit circle: more make more lobes.
    float lobes = 2.0F;
};
// The irregularity of the radius in a direction from the axis, about -1.8 to 1.8, in units of
// Turning::wide. out: unit vector, in the frame of the axis.
[[nodiscard]] float waverAt(const Turning& turning, glm::vec3 out);
void addTurned(Mesh& mesh,
               std::span<const Ring> rings,
               const Turning& turning,
               const Surface& surface);

// An ellipsoid with lumps, from its top down to capRadians.
struct Ball {
    glm::vec3 centre{};
    glm::vec3 radii{1.0F};
    float capRadians = 3.0F;
    int rings = 6;
    int around = 10;
    std::uint32_t seed = 0;
    // Height of the lumps relative to the radii, and their noise cells over a radius.
    float lumps = 0.1F;
    float cells = 2.0F;
};
void addBall(Mesh& mesh, const Ball& ball, const Surface& surface);

}  // namespace aquarama::scene
