// SPDX-License-Identifier: Apache-2.0
// Where everything is on a sheet, for who prints it and who reads it. Millimetres from the middle
// of the page, x to the right, y up: A4 and Letter, both landscape, differ only in their margins.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <glm/vec2.hpp>

#include "common/body/side_view.h"
#include "drawings/likeness.h"

namespace aquarama::drawings {

// The version of this layout: another one is told by the tags, and not read.
inline constexpr int kSheetVersion = 1;

// The corners of a sheet, in the order in which tags count them.
enum class Corner : std::uint8_t { UpperLeft, UpperRight, LowerRight, LowerLeft };
inline constexpr std::size_t kCorners = 4;

// What a tag says: its id in the family 36h11 is corner + 4 (species + 36 (version - 1)). The
// family has 587, enough for 36 species in four versions.
struct TagCode {
    int species = 0;  // its place in config/sheets.txt
    int version = kSheetVersion;
    Corner corner = Corner::UpperLeft;
    friend bool operator==(const TagCode&, const TagCode&) = default;
};
inline constexpr int kMostSpecies = 36;
inline constexpr int kMostVersions = 4;
[[nodiscard]] int idOf(const TagCode& code);
// Nothing where no sheet has such a tag.
[[nodiscard]] std::optional<TagCode> codeOf(int id);

// The rectangle about all black of the tags, 264 x 192 mm: within what printers print on either
// paper.
inline constexpr glm::dvec2 kFieldMillimetres{264, 192};
// The side of a tag's black border.
inline constexpr double kTagMillimetres = 22;

// The corners of a tag's black border: upper left, upper right, lower right, lower left.
using TagCorners = std::array<glm::dvec2, 4>;
[[nodiscard]] TagCorners tagOn(Corner corner);

// Where the skin of a species lies on its sheet: scale and upper left corner.
struct SkinOnSheet {
    double millimetresPerTexel = 1;
    glm::dvec2 upperLeft{};
    // Millimetres on the sheet, of a place in texels.
    [[nodiscard]] glm::dvec2 sheetAt(glm::dvec2 texel) const {
        return upperLeft + millimetresPerTexel * glm::dvec2{texel.x, -texel.y};
    }
    // Texels, of a place in millimetres.
    [[nodiscard]] glm::dvec2 texelAt(glm::dvec2 sheet) const {
        return glm::dvec2{sheet.x - upperLeft.x, upperLeft.y - sheet.y} / millimetresPerTexel;
    }
};
// As large as it fits between the tags, or between the columns of tags.
[[nodiscard]] SkinOnSheet placeOf(const Likeness& likeness);

// The middle of the line of text's base.
inline constexpr glm::dvec2 kLineOfText{0, -94};

}  // namespace aquarama::drawings
