// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/sign.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <limits>
#include <vector>

#include "common/base/log.h"
#include "render_node/gl/program.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::show {

namespace {

constexpr int kBlocks = 96;  // of the picture, along each side
constexpr float kFullWeight = 0.999F;

using Corner = config::Guests::Corner;

// The least weight of the pixels that show each block of the picture, bottom row first; 0 where
// none does.
class Weights {
  public:
    explicit Weights(const ProjectionMap& map) : least_(kBlocks * kBlocks, kNone) {
        for (const glm::vec4& pixel : map.placeAndWeight) {
            const glm::ivec2 block = glm::ivec2(glm::vec2(pixel) * float{kBlocks});
            if (block.x < 0 || block.y < 0 || block.x >= kBlocks || block.y >= kBlocks) continue;
            float& least = at(block);
            least = std::min(least, pixel.z);
        }
    }
    // Whether this channel alone lights all of it.
    [[nodiscard]] bool isFull(glm::ivec2 first, glm::ivec2 size) const {
        for (int y = first.y; y < first.y + size.y; ++y)
            for (int x = first.x; x < first.x + size.x; ++x) {
                const float least = least_[static_cast<std::size_t>(y * kBlocks + x)];
                if (least == kNone || least < kFullWeight) return false;
            }
        return true;
    }

  private:
    static constexpr float kNone = std::numeric_limits<float>::max();
    float& at(glm::ivec2 block) {
        return least_[static_cast<std::size_t>(block.y * kBlocks + block.x)];
    }
    std::vector<float> least_;
};

}  // namespace

std::optional<glm::vec4> signPlace(const ProjectionMap& map,
                                   Corner corner,
                                   double height,
                                   double widthByHeight,
                                   glm::ivec2 pictureSize) {
    const Weights weights(map);
    const double width = height * widthByHeight * pictureSize.y / pictureSize.x;
    const glm::ivec2 size = glm::ivec2(glm::ceil(glm::dvec2(width, height) * double{kBlocks})) + 1;
    const glm::ivec2 last = glm::ivec2(kBlocks) - size;
    const bool isRight = corner == Corner::LowerRight || corner == Corner::UpperRight;
    const bool isUpper = corner == Corner::UpperLeft || corner == Corner::UpperRight;
    std::optional<glm::ivec2> nearest;
    int least = std::numeric_limits<int>::max();
    for (int y = 0; y <= last.y; ++y)
        for (int x = 0; x <= last.x; ++x) {
            const int away = (isRight ? last.x - x : x) + (isUpper ? last.y - y : y);
            if (away >= least || !weights.isFull({x, y}, size)) continue;
            least = away;
            nearest = {x, y};
        }
    if (!nearest) return std::nullopt;
    // Half a block off the border on each side.
    const glm::dvec2 begin = (glm::dvec2(*nearest) + 0.5) / double{kBlocks};
    return glm::vec4(begin, begin + glm::dvec2(width, height));
}

SignPass::SignPass() : program_{gl::makeProgram({"sign.vert", "sign.frag"})} {}

void SignPass::draw(unsigned framebuffer,
                    glm::ivec2 sizePixels,
                    const wire::Sign& sign,
                    const glm::vec4& place) const {
    std::array<unsigned, shaders::kMostSignBytes / 4> words{};
    assert(sign.dots.size() <= shaders::kMostSignBytes);
    for (std::size_t i = 0; i < sign.dots.size(); ++i)
        words.at(i / 4) |= unsigned{static_cast<unsigned char>(sign.dots[i])} << (8 * (i % 4));
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, sizePixels.x, sizePixels.y);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glUseProgram(program_.name());
    glUniform4f(shaders::kSignPlaceLocation, place.x, place.y, place.z, place.w);
    glUniform2i(
        shaders::kSignSizeLocation, static_cast<int>(sign.columns), static_cast<int>(sign.rows));
    glUniform1uiv(shaders::kSignDotsLocation, static_cast<int>(words.size()), words.data());
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void ChannelSign::place(const wire::Sign& sign, const ProjectionMap& map, glm::ivec2 pictureSize) {
    const glm::uvec2 size(sign.columns, sign.rows);
    if (size == size_ || sign.columns == 0) return;
    size_ = size;
    const double widthByHeight = static_cast<double>(size.x) / static_cast<double>(size.y);
    place_ = signPlace(map, guests_.corner, guests_.height, widthByHeight, pictureSize);
    if (!place_)
        logWarning(
            "the sign for visitors fits nowhere beside the neighbours' light: give a smaller "
            "height, or another channel, in the rig's guests");
}

void ChannelSign::draw(unsigned framebuffer, glm::ivec2 sizePixels, const wire::Sign& sign) const {
    if (place_ && sign.columns > 0) pass_.draw(framebuffer, sizePixels, sign, *place_);
}

}  // namespace aquarama::show
