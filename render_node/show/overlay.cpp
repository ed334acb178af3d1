// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/overlay.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <vector>

#include <glm/common.hpp>

#include "render_node/gl/program.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::show {

namespace {

// Layout for overlay.vert.

// Size of a glyph with a margin of one dot above, below and on its left.
constexpr glm::vec2 kCellDots(kGlyphColumns + 1, kGlyphRows + 2);

// Layout of Glyph in overlay.vert, std430: the 64 bits as two words, the low one first.
struct Glyph {
    glm::vec2 topLeft{};
    glm::uvec2 bits{};
};

// One glyph for each character of all labels.
std::vector<Glyph> glyphsOf(std::span<const Label> labels, float dotPixels) {
    std::vector<Glyph> glyphs;
    for (const Label& label : labels) {
        glm::vec2 place = label.topLeft;
        // The blank at the end draws the right edge of the box.
        for (const char character : label.text + ' ') {
            const GlyphBits bits = glyphOf(character);
            glyphs.push_back({place, glm::uvec2(bits, bits >> 32U)});
            place.x += kCellDots.x * dotPixels;
        }
    }
    return glyphs;
}

}  // namespace

glm::vec2 extentInDots(const std::string& text) {
    return kCellDots * glm::vec2(static_cast<float>(text.size() + 1), 1);
}

TextOverlay::TextOverlay() : program_{gl::makeProgram({"overlay.vert", "overlay.frag"})} {}

void TextOverlay::draw(std::span<const Label> labels,
                       unsigned framebuffer,
                       glm::ivec2 sizePixels,
                       float dotPixels) {
    assert(dotPixels > 0.0F);
    if (labels.empty()) return;
    const std::vector<Glyph> glyphs = glyphsOf(labels, dotPixels);
    glNamedBufferData(glyphs_.name(),
                      static_cast<GLsizeiptr>(glyphs.size() * sizeof(Glyph)),
                      glyphs.data(),
                      GL_STREAM_DRAW);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, sizePixels.x, sizePixels.y);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glUseProgram(program_.name());
    glUniform2f(shaders::kPictureSizeLocation,
                static_cast<float>(sizePixels.x),
                static_cast<float>(sizePixels.y));
    glUniform1f(shaders::kDotPixelsLocation, dotPixels);
    gl::bindStorage(shaders::kGlyphsStorage, glyphs_);
    glBindVertexArray(noVertices_.name());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(glyphs.size()));
    glDisable(GL_BLEND);
}

namespace {

// Limits of the box, as shares of the picture: its greatest width, and a border that the overlap
// with neighbours and the floor may hide.
constexpr float kWidestShare = 0.6F;
constexpr float kBorderShare = 0.06F;
// Indent of a wrapped line: the column where the text of the master's lines begins.
constexpr std::string_view kIndent = "          ";
// The least width of the box in characters, even where that is more than kWidestShare.
constexpr float kLeastColumns = 24;

std::string inCapitals(std::string_view text) {
    std::string capitals(text);
    std::ranges::transform(capitals, capitals.begin(), [](unsigned char c) {
        return static_cast<char>(std::toupper(c));
    });
    return capitals;
}

// The number of characters of a line that fit, up to the end of a word where possible.
std::size_t fitting(std::string_view line, std::size_t columns) {
    if (line.size() <= columns) return line.size();
    const std::size_t space = line.rfind(' ', columns);
    const bool breaks = space != std::string_view::npos && space > kIndent.size();
    return breaks ? space : columns;
}

// Breaks the lines, in capitals, into rows of at most so many columns.
std::vector<std::string> wrapped(const std::vector<std::string>& lines, std::size_t columns) {
    std::vector<std::string> rows;
    for (const std::string& line : lines) {
        std::string rest = inCapitals(line);
        std::size_t size = fitting(rest, columns);
        rows.push_back(rest.substr(0, size));
        while (size < rest.size()) {
            const std::size_t next = rest.find_first_not_of(' ', size);
            if (next == std::string::npos) break;
            rest = std::string(kIndent) + rest.substr(next);
            size = fitting(rest, columns);
            rows.push_back(rest.substr(0, size));
        }
    }
    return rows;
}

// Pads all rows to the widest, so that their boxes form a rectangle.
void pad(std::vector<std::string>& rows) {
    std::size_t widest = 0;
    for (const std::string& row : rows) widest = std::max(widest, row.size());
    for (std::string& row : rows) row.resize(widest, ' ');
}

}  // namespace

std::vector<Label> mindLabels(const FishPlace& fish,
                              const WatchedMind& mind,
                              glm::ivec2 pictureSize,
                              float dotPixels) {
    assert(dotPixels > 0.0F);
    assert(pictureSize.x > 0);
    assert(pictureSize.y > 0);
    const glm::vec2 size(pictureSize);
    const glm::vec2 glyph =
        glm::vec2(extentInDots("A").x - extentInDots("").x, extentInDots("").y) * dotPixels;
    const glm::vec2 bracket = extentInDots("[") * dotPixels;
    const glm::vec2 reach(fish.halfLengthPixels + bracket.x / 2, 0);
    std::vector<Label> labels{{fish.middle - reach - bracket / 2.0F, "["},
                              {fish.middle + reach - bracket / 2.0F, "]"}};

    const glm::vec2 border = size * kBorderShare;
    const float columns = std::max(size.x * kWidestShare / glyph.x, kLeastColumns);
    const float mostRows = std::max((size.y - 2 * border.y) / glyph.y, 1.0F);
    std::vector<std::string> rows = wrapped(mind.lines, static_cast<std::size_t>(columns));
    rows.resize(std::min(rows.size(), static_cast<std::size_t>(mostRows)));
    if (rows.empty()) return labels;
    pad(rows);

    const glm::vec2 box(extentInDots(rows.front()).x * dotPixels,
                        glyph.y * static_cast<float>(rows.size()));
    const float aside = reach.x + bracket.x;
    const bool toTheRight = fish.middle.x < size.x / 2;
    const glm::vec2 desired(toTheRight ? fish.middle.x + aside : fish.middle.x - aside - box.x,
                            fish.middle.y - box.y / 2);
    glm::vec2 corner = glm::clamp(desired, border, glm::max(size - border - box, border));
    for (std::string& row : rows) {
        labels.push_back({corner, std::move(row)});
        corner.y += glyph.y;
    }
    return labels;
}

}  // namespace aquarama::show
