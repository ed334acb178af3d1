// SPDX-License-Identifier: Apache-2.0
// Masks and limits of blends that were set by hand: they change the shares of light of geometry or
// wall files.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "common/config/adjustments.h"

namespace aquarama::wall {

// A channel that lights a place: its share of the light there, and the most that masks leave it, 0
// to 1.
struct BlendPart {
    std::size_t channel = 0;
    double share = 0, mask = 1;
};

// Immutable; for any thread. Keeps a reference to the adjustments.
class AdjustedBlend {
  public:
    explicit AdjustedBlend(const config::Adjustments& adjustments) : adjustments_{adjustments} {}

    // Whether there are neither masks nor limits.
    [[nodiscard]] bool isIdentity() const {
        return adjustments_.masks.empty() && adjustments_.blends.empty();
    }
    // The light that masks leave this channel: 0 inside a mask, 1 beyond its soft edge. The place
    // is given in pixels of the channel's picture and of the panorama.
    [[nodiscard]] double mask(std::size_t channel, glm::dvec2 pixel, glm::dvec2 panorama) const;

    // The weight of a channel at a place of the panorama, in pixels; 0 at its picture's border and
    // beyond; nothing where the panorama has no screen.
    using Pulls = std::function<std::optional<double>(std::size_t channel, glm::dvec2 panorama)>;
    // Adjusts all parts at a place together. Their sum stays the same unless the masks of all leave
    // less.
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
