// SPDX-License-Identifier: Apache-2.0
// The card that the screens of a node without a key show: its letter, large, its code and its
// addresses.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "common/enrol/node_door.h"

namespace aquarama::show {

// A bright square of the card: pixels from the bottom left corner of the screen.
struct CardDot {
    glm::ivec2 corner{};
    int size = 0;
    friend bool operator==(const CardDot&, const CardDot&) = default;
};

// The dots of its lines, each as large as the screen's share for it allows. A screen of fewer
// pixels than a line has dots leaves that line out.
[[nodiscard]] std::vector<CardDot> cardDots(const enrol::NodeSign& sign, glm::ivec2 sizePixels);

// Draws the card into framebuffer 0 of the current context.
void drawCard(const enrol::NodeSign& sign, glm::ivec2 sizePixels);

}  // namespace aquarama::show
