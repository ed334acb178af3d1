// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/text_overlay.h"

#include <vector>

#include "render_node/gl/program.h"
#include "render_node/shaders/shader_interface.h"
#include "render_node/show/font.h"

namespace aquarama::show {

namespace {

// Places in overlay.vert.

// A glyph with a margin of one dot above, below and to its left.
constexpr glm::vec2 kCellDots(kGlyphColumns + 1, kGlyphRows + 2);

// As overlay.vert reads it.
struct Glyph {
    glm::vec2 topLeft{};
    glm::uvec2 bits{};
};

std::vector<Glyph> glyphsOf(std::span<const Label> labels, float dotPixels) {
    std::vector<Glyph> glyphs;
    for (const Label& label : labels) {
        glm::vec2 place = label.topLeft;
        for (const char character : label.text + ' ') {  // the space closes the box
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
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shaders::kGlyphsStorage, glyphs_.name());
    glBindVertexArray(noVertices_.name());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(glyphs.size()));
    glDisable(GL_BLEND);
}

}  // namespace aquarama::show
