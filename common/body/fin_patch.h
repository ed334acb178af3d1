// SPDX-License-Identifier: Apache-2.0
// A fin as a ruled patch: p runs along its base, q along each ray from base (0) to edge (1).
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "common/config/species.h"

namespace aquarama::body {

class FinPatch {
  public:
    explicit FinPatch(const config::Fin& fin);
    [[nodiscard]] glm::vec2 at(float p, float q) const;  // (s, y)
    [[nodiscard]] float rayAtStation(float s) const;     // the p whose base is at s
    // The same of a paddle: as round as the fin is, it is widest at half its length.
    [[nodiscard]] glm::vec2 paddleAt(float p, float q) const;
    [[nodiscard]] float angleRadians() const { return angleRadians_; }
    [[nodiscard]] glm::vec2 baseFront() const { return at(0, 0); }
    [[nodiscard]] glm::vec2 baseRear() const { return at(1, 0); }

  private:
    // Finely sampled, because p is even along the drawn points and not along the length.
    std::vector<float> p_;
    std::vector<float> baseS_, baseY_, edgeS_, edgeY_;
    float angleRadians_;
    float round_;
};

}  // namespace aquarama::body
