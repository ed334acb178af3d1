// SPDX-License-Identifier: Apache-2.0
// What the panels of projectors make of codes: linear light with the primaries of Rec. 709, in
// shares of their own white.
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

// A picture on its way from the panel. Four numbers a pixel, of which one is idle: it is read fast.
struct ThrownPicture {
    glm::ivec2 sizePixels{};  // of what the projector was sent; not always the channel's
    std::vector<glm::vec4> light;
    glm::vec4 black{};     // beside the picture
    glm::dvec2 scale{1};   // from pixels of the panel
    glm::dvec2 offset{0};  // in pixels of the picture

    // Bilinear, at a place on the panel.
    [[nodiscard]] glm::vec4 at(glm::vec2 panelPixel) const;
};

// Light of one colour and level of a projector: codes from 0 to 1.
[[nodiscard]] glm::vec3 lightOfCode(const config::HallProjector& projector, glm::vec3 code);

// What a channel's projector throws of a pattern, whose light is sent in codes of 8 bits, or of a
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
