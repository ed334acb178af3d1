// SPDX-License-Identifier: Apache-2.0
// The place: sea floor, rocks and plants as functions of its kind and a seed, the same in the
// master (avoidance) and the nodes (drawing).
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/scene.h"

namespace aquarama::place {

// World frame: metres, Y up. The surface of the sea is the plane y = 0; the reef's eye is at
// kEyePosition, looking along -Z.
inline constexpr glm::vec3 kEyePosition{0.0F, -6.0F, 0.0F};
inline constexpr float kMeanFloorDepthMetres = 8.6F;  // of the reef
inline constexpr float kOpenSeaFloorDepthMetres = 60.0F;

// All that a place follows from.
struct PlaceKey {
    std::uint32_t seed = 0;
    config::PlaceKind kind = config::PlaceKind::Reef;
};

// Height (y, negative) of the sand. Exact arithmetic only: the master's world depends on it.
[[nodiscard]] float floorHeight(const PlaceKey& place, glm::vec2 xz);

// A boulder, half sunk in the sand; everything that grows on it is within the radius.
struct Rock {
    glm::vec3 centre{};
    float radiusMetres = 0.0F;
    std::uint32_t seed = 0;
};
[[nodiscard]] std::vector<Rock> rocksOf(const PlaceKey& place);  // none in the open sea

enum class PlantKind : std::uint8_t { Kelp, Seagrass };

struct Plant {
    PlantKind kind = PlantKind::Kelp;
    glm::vec3 root{};  // on the sand
    float heightMetres = 0.0F;
    std::uint32_t seed = 0;
};
[[nodiscard]] std::vector<Plant> plantsOf(const PlaceKey& place);  // none in the open sea

// The water in which the school lives: fish keep inside it. Chosen so that the wall always has them
// in view.
struct Region {
    glm::vec3 centre{};
    glm::vec3 halfExtent{};
};

}  // namespace aquarama::place
