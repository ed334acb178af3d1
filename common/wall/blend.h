// SPDX-License-Identifier: Apache-2.0
// The blend of a whole rig made ready for many points: what blendWeight of wall.h computes.
#pragma once

#include <vector>

#include "common/wall/pinhole.h"

namespace aquarama::wall {

class Blend {
  public:
    explicit Blend(const config::Rig& rig);
    [[nodiscard]] double weight(std::size_t channel, glm::dvec3 screenPointMetres) const;
    [[nodiscard]] const Pinhole& projector(std::size_t channel) const {
        return projectors_[channel];
    }

  private:
    std::vector<Pinhole> projectors_;
};

}  // namespace aquarama::wall
