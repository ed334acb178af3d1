// SPDX-License-Identifier: Apache-2.0
// The light that projectors make from codes: linear, with the primaries of Rec. 709, as shares of
// the projector's own white.
#pragma once

#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "calibration/hall/true_hall.h"
#include "common/base/picture.h"
#include "common/config/hall.h"
#include "common/config/scan.h"

namespace aquarama::hall {

// A picture as it leaves the panel. Each pixel has a fourth, unused number, so that it is read
// fast.
struct ThrownPicture {
    glm::ivec2 sizePixels{};  // of the signal; not always the channel's
    std::vector<glm::vec4> light;
    glm::vec4 black{};     // beside the picture
    glm::dvec2 scale{1};   // from pixels of the panel
    glm::dvec2 offset{0};  // in pixels of the picture

    // The light at a place on the panel, bilinear.
    [[nodiscard]] glm::vec4 at(glm::vec2 panelPixel) const;
};

// The light of a projector for a code (0 to 1 in red, green and blue).
[[nodiscard]] glm::vec3 lightOfCode(const config::HallProjector& projector, glm::vec3 code);

// The light of a channel's projector for a pattern, which is sent in codes of 8 bits, or for a
// picture of the channel's size.
[[nodiscard]] ThrownPicture thrown(const TrueHall& hall,
                                   std::size_t channel,
                                   const config::ScanPattern& pattern);
[[nodiscard]] ThrownPicture thrown(const TrueHall& hall, std::size_t channel, const Light& picture);
// One picture for each channel, in the rig's order.
[[nodiscard]] std::vector<ThrownPicture> allThrown(const TrueHall& hall,
                                                   std::span<const Light> channels);
// Full white all over.
[[nodiscard]] ThrownPicture thrownWhite(const TrueHall& hall, std::size_t channel);

}  // namespace aquarama::hall
