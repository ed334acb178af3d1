// SPDX-License-Identifier: Apache-2.0
// The sheet of a species, which a visitor colours.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "common/config/species.h"
#include "drawings/layout.h"
#include "drawings/likeness.h"

namespace aquarama::drawings {

// All that a sheet shows, and what its reader needs to know of it. Immutable.
struct Sheet {
    std::string species;
    int number = 0;  // of the species (TagCode)
    Likeness likeness;
    SkinOnSheet place;
};

// number: the species' place in the list of sheets.
[[nodiscard]] Sheet makeSheet(const config::Species& species, int number);

// Width of the line that is printed along the outline, half of it within.
inline constexpr double kOutlineMillimetres = 0.9;

// Papers, landscape, in millimetres.
inline constexpr glm::dvec2 kA4{297, 210};
inline constexpr glm::dvec2 kLetter{279.4, 215.9};

// The PDF of a sheet, with a line that says what to do. Throws Error where it cannot be drawn.
[[nodiscard]] std::vector<std::byte> pdfOf(const Sheet& sheet,
                                           glm::dvec2 paperMillimetres,
                                           const std::string& line);

}  // namespace aquarama::drawings
