// SPDX-License-Identifier: Apache-2.0
// Noise in space for what is only drawn; a stream of random numbers for shapes.
#pragma once

#include <cstdint>
#include <span>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/units/hash.h"
#include "render_node/reef/mesh.h"

namespace aquarama::scene {

[[nodiscard]] float solidNoise(std::uint32_t seed, glm::vec3 place);            // -1 to 1
[[nodiscard]] float billows(std::uint32_t seed, glm::vec3 place, int octaves);  // about +-1
[[nodiscard]] float ridges(std::uint32_t seed, glm::vec3 place, int octaves);   // crests at +1

class Dice {
  public:
    explicit Dice(std::uint32_t seed) : seed_{seed} {}
    float unit() { return unitOf(hashOf(seed_, count_++)); }
    float between(float low, float high) { return low + (high - low) * unit(); }
    std::uint32_t seed() { return hashOf(seed_, count_++); }

  private:
    std::uint32_t seed_;
    std::uint32_t count_ = 0;
};

// Columns x, y, z with y along `up`, turned about it.
[[nodiscard]] glm::mat3 frameAbout(glm::vec3 up, float turnRadians);

// The building blocks of what grows: tubes, ribbons and turned bodies.

struct Joint {
    glm::vec3 centre{};
    float radius = 0.0F;
    Surface surface{};
    float openness = 1.0F;
};
// A tube through the joints; sides 0: a flat ribbon whose face is turned to `facing`.
void addStrand(Mesh& mesh, std::span<const Joint> joints, int sides, glm::vec3 facing = {0, 0, 1});

// A leaf along the joints, its width across in the direction `side`, folded at the midrib; ruffled
// by so many waves of a share of its width.
struct Leaf {
    glm::vec3 side{};
    float ruffle = 0.0F;
    float waves = 0.0F;
    float phase = 0.0F;
};
void addLeaf(Mesh& mesh, std::span<const Joint> joints, const Leaf& leaf);

// A body of revolution about y, from foot to crown, made irregular: radii and heights waver with
// the angle by noise of so many lobes.
struct Ring {
    float radius;
    float height;
    float openness = 1.0F;
    float shade = 1.0F;  // of the surface's albedo
    float waver = 1.0F;  // share of the irregularity
};
struct Turning {
    glm::vec3 centre{};
    glm::vec3 up{0, 1, 0};
    int around = 12;
    std::uint32_t seed = 0;
    float wide = 0.0F;   // of the radius
    float high = 0.0F;   // metres
    float lobes = 2.0F;  // noise cells over the unit circle
};
// By how much its radius wavers where, as a share of Turning::wide.
[[nodiscard]] float waverAt(std::uint32_t seed, glm::vec3 place);
void addTurned(Mesh& mesh,
               std::span<const Ring> rings,
               const Turning& turning,
               const Surface& surface);

// A ball of the unit sphere's cap down to so many radians, lumpy.
struct Ball {
    glm::vec3 centre{};
    glm::vec3 radii{1.0F};
    float capRadians = 3.0F;
    int rings = 6;
    int around = 10;
    std::uint32_t seed = 0;
    float lumps = 0.1F;
    float cells = 2.0F;
};
void addBall(Mesh& mesh, const Ball& ball, const Surface& surface);

}  // namespace aquarama::scene
