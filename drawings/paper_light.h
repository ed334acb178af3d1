// SPDX-License-Identifier: Apache-2.0
// The light that falls on a sheet, by what its bare paper sends back.
#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "drawings/flatten.h"
#include "drawings/photo.h"
#include "drawings/sheet.h"

namespace aquarama::drawings {

// What white paper would be in a photo at each place of its sheet: linear light, red, green, blue.
class PaperLight {
  public:
    // Measures the paper around the outline. Throws Refusal, TooDark, where there is none.
    PaperLight(const PhotoLight& photo, const Flattening& flat, const Sheet& sheet);
    [[nodiscard]] glm::vec3 at(glm::dvec2 sheet) const;

  private:
    glm::ivec2 size_{};
    std::vector<glm::vec3> white_;  // on a grid, row by row
};

}  // namespace aquarama::drawings
