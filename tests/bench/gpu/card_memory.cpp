// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/gpu/card_memory.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <epoxy/gl.h>

namespace aquarama::bench {

namespace {

// Drivers name objects from 1 upwards: far more than a process makes here.
constexpr GLuint kNames = 1U << 14U;
constexpr double kMebibyte = 1024.0 * 1024.0;

std::int64_t levelParameter(GLuint texture, GLint level, GLenum parameter) {
    GLint value = 0;
    glGetTextureLevelParameteriv(texture, level, parameter, &value);
    return value;
}

double bytesOfLevel(GLuint texture, GLint level) {
    const auto of = [&](GLenum parameter) { return levelParameter(texture, level, parameter); };
    constexpr std::array<GLenum, 6> kSizes{GL_TEXTURE_RED_SIZE,
                                           GL_TEXTURE_GREEN_SIZE,
                                           GL_TEXTURE_BLUE_SIZE,
                                           GL_TEXTURE_ALPHA_SIZE,
                                           GL_TEXTURE_DEPTH_SIZE,
                                           GL_TEXTURE_STENCIL_SIZE};
    std::int64_t bits = 0;
    for (const GLenum size : kSizes) bits += of(size);
    const std::int64_t texels = of(GL_TEXTURE_WIDTH) * of(GL_TEXTURE_HEIGHT) *
                                std::max<std::int64_t>(of(GL_TEXTURE_DEPTH), 1);
    const std::int64_t samples = std::max<std::int64_t>(of(GL_TEXTURE_SAMPLES), 1);
    return static_cast<double>(texels * bits * samples) / 8;
}

double bytesOfBuffer(GLuint buffer) {
    GLint64 bytes = 0;
    glGetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &bytes);
    return static_cast<double>(bytes);
}

}  // namespace

double textureBytes(unsigned texture) {
    // A buffer as a texture, which is counted as a buffer.
    if (levelParameter(texture, 0, GL_TEXTURE_BUFFER_DATA_STORE_BINDING) != 0) return 0;
    GLint levels = 0;
    glGetTextureParameteriv(texture, GL_TEXTURE_IMMUTABLE_LEVELS, &levels);
    double bytes = 0;
    for (GLint level = 0; level < levels; ++level) bytes += bytesOfLevel(texture, level);
    return bytes;
}

CardMemory cardMemory() {
    CardMemory memory;
    for (GLuint name = 1; name < kNames; ++name) {
        if (glIsTexture(name) == GL_TRUE) memory.textureMebibytes += textureBytes(name) / kMebibyte;
        if (glIsBuffer(name) == GL_TRUE) memory.bufferMebibytes += bytesOfBuffer(name) / kMebibyte;
    }
    return memory;
}

std::optional<double> freeMebibytes() {
    if (!epoxy_has_gl_extension("GL_NVX_gpu_memory_info")) return std::nullopt;
    GLint kibibytes = 0;
    glGetIntegerv(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX, &kibibytes);
    return kibibytes / 1024.0;
}

}  // namespace aquarama::bench
