// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/node_card.h"

#include <algorithm>
#include <string>

#include <epoxy/gl.h>

#include "common/base/dot_font.h"

namespace aquarama::show {

namespace {

// A line of the card: its place and its height are shares of the screen's height, from its bottom.
struct CardLine {
    std::string text;
    double bottom = 0, height = 0;
};

std::string listed(const std::vector<std::string>& addresses) {
    constexpr std::size_t kMost = 2;  // more would be too small to read
    std::string list;
    for (std::size_t i = 0; i < std::min(kMost, addresses.size()); ++i)
        list += (list.empty() ? "" : "  ") + addresses[i];
    return list.empty() ? "NO NETWORK" : list;
}

std::vector<CardLine> linesOf(const enrol::NodeSign& sign) {
    return {{sign.letter, 0.42, 0.5},
            {sign.letter.empty() ? "LOOKING FOR THE NETWORK" : "CODE " + sign.code, 0.25, 0.1},
            {listed(sign.addresses), 0.14, 0.05},
            {"GIVE IT A CHANNEL IN THE CONSOLE", 0.06, 0.03}};
}

constexpr int kAdvance = static_cast<int>(kGlyphColumns) + 1;
constexpr int kRows = static_cast<int>(kGlyphRows);

void addGlyph(std::vector<CardDot>& dots, char character, glm::ivec2 corner, int size) {
    const GlyphBits bits = glyphOf(character);
    for (std::size_t row = 0; row < kGlyphRows; ++row)
        for (std::size_t column = 0; column < kGlyphColumns; ++column) {
            if ((bits >> (row * kGlyphColumns + column) & 1U) == 0) continue;
            const glm::ivec2 place(static_cast<int>(column), kRows - 1 - static_cast<int>(row));
            dots.push_back({corner + size * place, size});
        }
}

// In the middle, within nine tenths of the width.
void addLine(std::vector<CardDot>& dots, const CardLine& line, glm::ivec2 sizePixels) {
    if (line.text.empty()) return;
    const int columns = static_cast<int>(line.text.size()) * kAdvance - 1;
    const int size = static_cast<int>(
        std::min(line.height * sizePixels.y / kRows, 0.9 * sizePixels.x / columns));
    glm::ivec2 corner((sizePixels.x - columns * size) / 2,
                      static_cast<int>(line.bottom * sizePixels.y));
    if (size == 0) return;
    for (const char character : line.text) {
        addGlyph(dots, character, corner, size);
        corner.x += kAdvance * size;
    }
}

}  // namespace

std::vector<CardDot> cardDots(const enrol::NodeSign& sign, glm::ivec2 sizePixels) {
    std::vector<CardDot> dots;
    for (const CardLine& line : linesOf(sign)) addLine(dots, line, sizePixels);
    return dots;
}

// Cleared squares: no program is compiled for this.
void drawCard(const enrol::NodeSign& sign, glm::ivec2 sizePixels) {
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0.0F, 0.05F, 0.1F, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
    glClearColor(0.9F, 0.95F, 1, 1);
    for (const CardDot& dot : cardDots(sign, sizePixels)) {
        glScissor(dot.corner.x, dot.corner.y, dot.size, dot.size);
        glClear(GL_COLOR_BUFFER_BIT);
    }
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace aquarama::show
