// SPDX-License-Identifier: Apache-2.0
#include "render_node/gl/handle.h"

#include <algorithm>
#include <cassert>

#include "common/base/log.h"

namespace aquarama::gl {

namespace {

// The GL type of a sample, for glReadPixels.
template <class Sample>
constexpr GLenum kTypeOf = GL_NONE;
template <>
constexpr GLenum kTypeOf<std::uint8_t> = GL_UNSIGNED_BYTE;
template <>
constexpr GLenum kTypeOf<std::uint16_t> = GL_UNSIGNED_SHORT;
template <>
constexpr GLenum kTypeOf<float> = GL_FLOAT;

}  // namespace

Target::Target(GLenum format, glm::ivec2 sizePixels) : size_{sizePixels}, colour_{GL_TEXTURE_2D} {
    assert(size_.x > 0);
    assert(size_.y > 0);
    glTextureStorage2D(colour_.name(), 1, format, size_.x, size_.y);
    glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, colour_.name(), 0);
    if (glCheckNamedFramebufferStatus(framebuffer_.name(), GL_FRAMEBUFFER) !=
        GL_FRAMEBUFFER_COMPLETE) {
        throw Error("the graphics driver cannot draw into a picture of " + std::to_string(size_.x) +
                    " x " + std::to_string(size_.y) +
                    " pixels; make the channel smaller or update the driver");
    }
}

template <class Sample>
std::vector<Sample> readRgb(const Target& target) {
    static_assert(kTypeOf<Sample> != GL_NONE);
    const auto rowSamples = static_cast<std::size_t>(target.sizePixels().x) * 3;
    const auto rows = static_cast<std::size_t>(target.sizePixels().y);
    std::vector<Sample> pixels(rowSamples * rows);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer());
    // Rows of three samples are not multiples of four bytes, GL's default.
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(
        0, 0, target.sizePixels().x, target.sizePixels().y, GL_RGB, kTypeOf<Sample>, pixels.data());
    // OpenGL delivers the bottom row first: swap the rows from the outside inwards.
    const auto row = [&](std::size_t index) {
        return pixels.begin() + static_cast<std::ptrdiff_t>(index * rowSamples);
    };
    for (std::size_t top = 0, bottom = rows - 1; top < bottom; ++top, --bottom)
        std::swap_ranges(row(top), row(top + 1), row(bottom));
    return pixels;
}

template std::vector<std::uint8_t> readRgb(const Target&);
template std::vector<std::uint16_t> readRgb(const Target&);
template std::vector<float> readRgb(const Target&);

void waitForGpu() {
    constexpr GLuint64 kASecond = 1'000'000'000;
    const GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    while (glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kASecond) == GL_TIMEOUT_EXPIRED) {
    }
    glDeleteSync(fence);
}

}  // namespace aquarama::gl
