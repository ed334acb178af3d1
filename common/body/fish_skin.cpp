// SPDX-License-Identifier: Apache-2.0
#include "common/body/fish_skin.h"

#include <algorithm>
#include <string_view>

#include "common/config/species.h"

namespace aquarama::body {

namespace {

glm::vec3 colourOf(const config::Species& species,
                   std::string_view part,
                   const glm::vec3& otherwise) {
    const auto paint = std::ranges::find(species.palette, part, &config::Paint::part);
    return paint == species.palette.end() ? otherwise : paint->linear;
}

}  // namespace

FishSkin skinOf(const config::Species& species) {
    return {.species = species.name,
            .back = colourOf(species, "back", {0.05F, 0.08F, 0.10F}),
            .flank = colourOf(species, "flank", {0.40F, 0.42F, 0.40F}),
            .belly = colourOf(species, "belly", {0.70F, 0.70F, 0.68F})};
}

}  // namespace aquarama::body
