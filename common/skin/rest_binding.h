// SPDX-License-Identifier: Apache-2.0
// Places beside the cage as weighted sums of four control points of the body, which take them
// along.
#pragma once

#include <array>
#include <cstdint>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "common/body/fish_body.h"

namespace aquarama::skin {

// The part of the body about a station, as an affine frame.
class RestBinding {
  public:
    RestBinding(const body::ControlCage& cage, float station);

    using Points = std::array<std::uint32_t, 4>;
    using Weights = std::array<float, 4>;
    [[nodiscard]] const Points& points() const { return points_; }
    [[nodiscard]] Weights ofPlace(glm::vec3 rest) const;           // they sum to 1
    [[nodiscard]] Weights ofDirection(glm::vec3 direction) const;  // they sum to 0

  private:
    Points points_{};
    glm::mat4 weightsFromRest_{1.0F};
};

}  // namespace aquarama::skin
