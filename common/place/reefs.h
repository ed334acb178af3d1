// SPDX-License-Identifier: Apache-2.0
// A reef that is repeated on a grid, for worlds of very many fish: with its sand, rocks and sites,
// as often as Scene::reefs says, to the right of the first and behind it. World frame, metres.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/place/place.h"
#include "common/place/sites.h"

namespace aquarama::place {

// How many reefs there are.
[[nodiscard]] std::size_t reefsOf(const PlaceKey& place);
// From the first reef to another, by its number from 0.
[[nodiscard]] glm::vec3 reefOffset(const PlaceKey& place, std::size_t reef);
// The place of the first reef alone.
[[nodiscard]] PlaceKey firstReefOf(const PlaceKey& place);
// The point of the first reef that looks as a point (x, z) does; within the settled water.
[[nodiscard]] glm::vec2 inFirstReef(const PlaceKey& place, glm::vec2 xz);
// Of the rocks of the first reef those that reach into its water, in all reefs; reef by reef.
[[nodiscard]] std::vector<Rock> inAllReefs(const PlaceKey& place, const std::vector<Rock>& rocks);
// The sites of the first reef in all reefs: each of them in all reefs, and then the next.
[[nodiscard]] std::vector<Site> inAllReefs(const PlaceKey& place, const std::vector<Site>& sites);

// Whether a rock reaches into a region in plan, so far that it may bear sites.
[[nodiscard]] bool reachesInto(const Region& region, const Rock& rock);

}  // namespace aquarama::place
