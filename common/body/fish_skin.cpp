// SPDX-License-Identifier: Apache-2.0
#include "common/body/fish_skin.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "common/config/species.h"

namespace aquarama {

namespace {

constexpr std::array kPainted{
    std::pair{std::string_view("bigeye_scad"), SkinPattern::BigeyeScad},
    std::pair{std::string_view("clownfish"), SkinPattern::Clownfish},
    std::pair{std::string_view("moorish_idol"), SkinPattern::MoorishIdol},
    std::pair{std::string_view("blue_tang"), SkinPattern::BlueTang},
    std::pair{std::string_view("parrotfish"), SkinPattern::Parrotfish},
    std::pair{std::string_view("trumpetfish"), SkinPattern::Trumpetfish},
    std::pair{std::string_view("blacktip_reef_shark"), SkinPattern::BlacktipReefShark}};

glm::vec3 colourOf(const Species& species, std::string_view part, const glm::vec3& otherwise) {
    const auto paint = std::ranges::find(species.palette, part, &Paint::part);
    return paint == species.palette.end() ? otherwise : paint->linear;
}

}  // namespace

FishSkin skinOf(const Species& species) {
    const auto painted = std::ranges::find(
        kPainted, std::string_view(species.name), [](const auto& entry) { return entry.first; });
    return {.pattern = painted == kPainted.end() ? SkinPattern::Plain : painted->second,
            .back = colourOf(species, "back", {0.05F, 0.08F, 0.10F}),
            .flank = colourOf(species, "flank", {0.40F, 0.42F, 0.40F}),
            .belly = colourOf(species, "belly", {0.70F, 0.70F, 0.68F})};
}

}  // namespace aquarama
