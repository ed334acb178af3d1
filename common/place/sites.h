// SPDX-License-Identifier: Apache-2.0
// The sites of a place: where its animals live, hide, feed and are cleaned. Equal in the master,
// for minds, and in the nodes, which draw what is to be seen of them. World frame, metres.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/config/scene.h"
#include "common/place/place.h"

namespace aquarama::place {

// One site on a boulder. The surface that is drawn is within a tenth of the boulder's radius of it.
struct Site {
    config::SiteKind kind = config::SiteKind::Hole;
    glm::vec3 place{};
    glm::vec3 normal{0, 1, 0};   // of the boulder, a unit vector
    float sizeMetres = 0.3F;     // across
    std::uint32_t seed = 0;      // of its details
    std::uint32_t rockSeed = 0;  // names its boulder
};

// All sites, computed at every call, in the order of the scene's groups. None where no boulder
// reaches into the settled water; of turf, where fish graze. Exact arithmetic only.
[[nodiscard]] std::vector<Site> sitesOf(const PlaceKey& place);

// Whether fish that keep within this water can graze at a place: they turn back near its borders.
[[nodiscard]] bool isGrazed(const Region& water, glm::vec3 place);

// Whether fish can hide at a site of this kind.
[[nodiscard]] constexpr bool isShelter(config::SiteKind kind) {
    return kind == config::SiteKind::Anemone || kind == config::SiteKind::Branching ||
           kind == config::SiteKind::Hole || kind == config::SiteKind::Ledge;
}

}  // namespace aquarama::place
