// SPDX-License-Identifier: Apache-2.0
// Masks and limits of blends that were set by hand, on top of the shares of light that geometry or
// wall files give.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "common/config/adjustments.h"

namespace aquarama::wall {

// A channel that lights a place: its share of the light there, and what masks leave it at most, 0
// to 1.
struct BlendPart {
    std::size_t channel = 0;
    double share = 0, mask = 1;
};

// Immutable; for any thread. Keeps a reference to the adjustments.
class AdjustedBlend {
  public:
    explicit AdjustedBlend(const config::Adjustments& adjustments) : adjustments_{adjustments} {}

    // There are neither masks nor limits.
    [[nodiscard]] bool isIdentity() const {
        return adjustments_.masks.empty() && adjustments_.blends.empty();
    }
    // 0 inside a mask of this channel, 1 beyond its soft edge. Pixels of the channel's picture and
    // of the panorama.
    [[nodiscard]] double mask(std::size_t channel, glm::dvec2 pixel, glm::dvec2 panorama) const;

    // How strongly a channel reaches a place of the panorama, in pixels; 0 at its picture's border
    // and beyond; nothing where the panorama has no screen.
    using Pulls = std::function<std::optional<double>(std::size_t channel, glm::dvec2 panorama)>;
    // All the parts at a place, together. Their sum stays what it is, but where masks of all of
    // them leave less.
    void adjust(std::vector<BlendPart>& parts, glm::dvec2 panorama, const Pulls& pulls) const;

  private:
    [[nodiscard]] std::optional<double> widthOf(std::size_t one, std::size_t other) const;
    [[nodiscard]] double narrowed(std::size_t one,
                                  std::size_t other,
                                  glm::dvec2 panorama,
                                  const Pulls& pulls) const;

    const config::Adjustments& adjustments_;
};

}  // namespace aquarama::wall
