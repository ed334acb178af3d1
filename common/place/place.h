// SPDX-License-Identifier: Apache-2.0
// The place of a scene, and the arithmetic that it and the behaviour need to be the same on every
// machine: no libm but sqrt, since two machines' libm do not agree to the bit.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/scene.h"

namespace aquarama::place {

inline constexpr float kPi = 3.14159265F;

// Angle of (x, y) from the x axis, -pi to pi, within 2e-5 rad (Abramowitz & Stegun 4.4.49); 0 for
// (0, 0).
[[nodiscard]] constexpr float angleOf(float y, float x) {
    const float absX = x < 0 ? -x : x;
    const float absY = y < 0 ? -y : y;
    const float larger = std::max(absX, absY);
    if (larger <= 0) return 0;
    const float t = std::min(absX, absY) / larger;
    const float s = t * t;
    const float tail = -0.3302995F + s * (0.1801410F + s * (-0.0851330F + s * 0.0208351F));
    float angle = t * (0.9998660F + s * tail);
    if (absY > absX) angle = kPi / 2 - angle;
    if (x < 0) angle = kPi - angle;
    return y < 0 ? -angle : angle;
}

// Scalar product as of glm, with a fixed order of additions.
[[nodiscard]] inline float dot(glm::vec3 a, glm::vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Euclidean length.
[[nodiscard]] inline float lengthOf(glm::vec3 v) {
    return std::sqrt(dot(v, v));
}

// The unit vector along v; `otherwise` where v is shorter than 10^-6.
[[nodiscard]] inline glm::vec3 directionOf(glm::vec3 v, glm::vec3 otherwise) {
    const float length = lengthOf(v);
    return length > 1.0e-6F ? v / length : otherwise;
}

// The turn about the world's up, in radians, that brings the horizontal course of `from` to that of
// `to`; left positive.
[[nodiscard]] inline float yawBetween(glm::vec3 from, glm::vec3 to) {
    return angleOf(from.z * to.x - from.x * to.z, from.x * to.x + from.z * to.z);
}

// Sine of the steepest climb or dive that a fish chooses, 25 degrees.
inline constexpr float kSteepest = 0.42F;

// A unit direction limited to the steepest climb or dive. Keeps its course; a vertical direction
// has none and becomes (1, 0, 0).
[[nodiscard]] inline glm::vec3 levelled(glm::vec3 direction) {
    const float y = std::clamp(direction.y, -kSteepest, kSteepest);
    const float horizontal = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    if (horizontal < 1.0e-4F) return {1, 0, 0};
    const float scale = std::sqrt(1 - y * y) / horizontal;
    return {direction.x * scale, y, direction.z * scale};
}

// Noise by integer hashes: the same bits on every machine, from a seed and a place alone.

// Smooth (C2) value noise, -1 to 1, lattice of side 1; defined up to 10^6 cells from the origin,
// constant beyond.
[[nodiscard]] float valueNoise(std::uint32_t seed, glm::vec2 place);

// Octaves of it, each of twice the frequency and half the height; within -2 to 2. The cost is one
// valueNoise() for each octave.
[[nodiscard]] float fractalNoise(std::uint32_t seed, glm::vec2 place, int octaves);

// The place: sea floor, rocks and plants as functions of its kind and a seed, equal in the master,
// for avoidance, and in the nodes, for drawing.

// World frame: metres, Y up. The surface of the sea is the plane y = 0; the reef's eye is at
// kEyePosition, looking along -Z.
inline constexpr glm::vec3 kEyePosition{0.0F, -6.0F, 0.0F};
inline constexpr float kMeanFloorDepthMetres = 8.6F;  // of the reef
inline constexpr float kOpenSeaFloorDepthMetres = 60.0F;

// The water in which the school lives, as a box in the world frame (metres): fish keep inside it.
// Chosen so that the wall always has them in view.
struct Region {
    glm::vec3 centre{};
    glm::vec3 halfExtent{};
    friend bool operator==(const Region&, const Region&) = default;
};

// The parameters of a place: equal keys have equal places on every machine.
struct PlaceKey {
    std::uint32_t seed = 0;
    config::PlaceKind kind = config::PlaceKind::Reef;
    // What a scene adds: boulders, and sites on those that reach into this water (sites.h).
    std::vector<config::Head> heads = {};
    std::vector<config::SiteGroup> sites = {};
    Region settled = {};
    // As Scene::reefs (reefs.h).
    glm::uvec2 reefs{1, 1};
    friend bool operator==(const PlaceKey&, const PlaceKey&) = default;
};
// The place of a scene.
[[nodiscard]] PlaceKey placeOf(const config::Scene& scene, std::uint32_t seed);

// Height (y in metres, negative) of the sand at (x, z). Exact arithmetic only: the master's world
// depends on it.
[[nodiscard]] float floorHeight(const PlaceKey& place, glm::vec2 xz);

// A boulder that lies in the sand or on others, as a sphere; everything that grows on it is within
// the radius. The seed decides its details.
struct Rock {
    glm::vec3 centre{};
    float radiusMetres = 0.0F;
    std::uint32_t seed = 0;
};
// The surface that is drawn, in radii: a boulder is worn within its radius.
inline constexpr float kDrawnRadii = 0.9F;
// All rocks, computed at every call, those of heads last; none in the open sea.
[[nodiscard]] std::vector<Rock> rocksOf(const PlaceKey& place);

// What a plant looks like.
enum class PlantKind : std::uint8_t { Kelp, Seagrass };

// One plant; the seed decides its details.
struct Plant {
    PlantKind kind = PlantKind::Kelp;
    glm::vec3 root{};  // on the sand
    float heightMetres = 0.0F;
    std::uint32_t seed = 0;
};
// All plants, computed at every call with the rocks; none in the open sea.
[[nodiscard]] std::vector<Plant> plantsOf(const PlaceKey& place);

// The water that a scene has for a number of fish.

// The water of a scene for so many fish of a mean length: the scene's own box, or a larger one with
// SceneWater::leastLengthsCubed for each fish. It grows to both sides and away from the eye; in the
// open sea also downwards. The face towards the eye and the top stay.
[[nodiscard]] Region waterFor(const config::Scene& scene, std::size_t fish, float meanLengthMetres);

// The region of the submarine: the box around the fish's water and the eye, with a margin of four
// metres, below the surface. It ignores the sand.
[[nodiscard]] Region roamingRegion(const Region& fishWater, glm::vec3 eye);

// How many fish have room: a reef is limited by its rocks, the open sea only by kMostFish.
[[nodiscard]] std::uint32_t mostFishIn(const config::Scene& scene, float meanLengthMetres);

// Throws Error where `fish`, the number of all members, is more than there is room for; it names
// the place of the first member in the scene's file. Also throws Error, naming its place, where the
// box, the eye or a stop of the tour is below the floor, or a stop is outside of roamingRegion().
// The scene has at least one member.
void checkRoom(const config::Scene& scene,
               const std::string& scenePath,
               std::size_t fish,
               float meanLengthMetres);

}  // namespace aquarama::place
