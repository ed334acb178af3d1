// SPDX-License-Identifier: Apache-2.0
// RAII owners of OpenGL objects: names, labelled buffers, a picture to draw into.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <epoxy/gl.h>
#include <glm/vec2.hpp>

namespace aquarama::gl {

// Sole owner of one OpenGL name. Traits supply create() or create(kind), and destroy(name). Create
// and destroy it on the thread where its context is current. A moved-from handle may only be
// assigned or destroyed.
template <class Traits>
class Handle {
  public:
    Handle() : name_{Traits::create()} {}
    explicit Handle(GLenum kind) : name_{Traits::create(kind)} {}
    ~Handle() {
        if (name_ != 0) Traits::destroy(name_);
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    Handle(Handle&& other) noexcept : name_{std::exchange(other.name_, 0U)} {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(name_, other.name_);  // our old name leaves with `other`
        return *this;
    }

    // OpenGL's name of the object.
    [[nodiscard]] unsigned name() const { return name_; }

  private:
    unsigned name_;
};

// Traits of each kind of object. They use direct state access (OpenGL 4.5): create() makes an
// object, not a mere name, so that it can be used without being bound.
struct BufferTraits {
    // Makes an object.
    static unsigned create() {
        unsigned name = 0;
        glCreateBuffers(1, &name);
        return name;
    }
    // Deletes it.
    static void destroy(unsigned name) { glDeleteBuffers(1, &name); }
};
struct TextureTraits {
    // Makes an object.
    static unsigned create(GLenum target) {
        unsigned name = 0;
        glCreateTextures(target, 1, &name);
        return name;
    }
    // Deletes it.
    static void destroy(unsigned name) { glDeleteTextures(1, &name); }
};
struct FramebufferTraits {
    // Makes an object.
    static unsigned create() {
        unsigned name = 0;
        glCreateFramebuffers(1, &name);
        return name;
    }
    // Deletes it.
    static void destroy(unsigned name) { glDeleteFramebuffers(1, &name); }
};
struct VertexArrayTraits {
    // Makes an object.
    static unsigned create() {
        unsigned name = 0;
        glCreateVertexArrays(1, &name);
        return name;
    }
    // Deletes it.
    static void destroy(unsigned name) { glDeleteVertexArrays(1, &name); }
};
struct SamplerTraits {
    // Makes an object.
    static unsigned create() {
        unsigned name = 0;
        glCreateSamplers(1, &name);
        return name;
    }
    // Deletes it.
    static void destroy(unsigned name) { glDeleteSamplers(1, &name); }
};
struct ProgramTraits {
    // Makes an object.
    static unsigned create() { return glCreateProgram(); }
    // Deletes it.
    static void destroy(unsigned name) { glDeleteProgram(name); }
};

// Handles of OpenGL's objects, each deleted with its handle.
using Buffer = Handle<BufferTraits>;
using Texture = Handle<TextureTraits>;
using Sampler = Handle<SamplerTraits>;
using Framebuffer = Handle<FramebufferTraits>;
using VertexArray = Handle<VertexArrayTraits>;
using ProgramHandle = Handle<ProgramTraits>;

// Buffers of fixed size with a label, which debuggers show.

// A buffer of so many bytes, not initialised. OpenGL refuses an empty buffer: it has at least 16
// bytes. flags: as glNamedBufferStorage takes them, 0 for what only the GPU writes.
[[nodiscard]] inline Buffer makeBuffer(std::size_t bytes, const char* label, GLbitfield flags = 0) {
    assert(label != nullptr);
    Buffer buffer;
    const auto size = static_cast<GLsizeiptr>(std::max<std::size_t>(bytes, 16));
    glNamedBufferStorage(buffer.name(), size, nullptr, flags);
    glObjectLabel(GL_BUFFER, buffer.name(), -1, label);
    return buffer;
}

// A buffer that holds the values, as they lie in memory.
template <class T>
[[nodiscard]] Buffer makeBuffer(std::span<const T> values,
                                const char* label,
                                GLbitfield flags = 0) {
    if (values.empty()) return makeBuffer(0, label, flags);
    Buffer buffer;
    const auto size = static_cast<GLsizeiptr>(values.size_bytes());
    glNamedBufferStorage(buffer.name(), size, values.data(), flags);
    glObjectLabel(GL_BUFFER, buffer.name(), -1, label);
    return buffer;
}
template <class T>
[[nodiscard]] Buffer makeBuffer(const std::vector<T>& values,
                                const char* label,
                                GLbitfield flags = 0) {
    return makeBuffer(std::span<const T>{values}, label, flags);
}

// Binds a buffer as shader storage, for the kernels and draws that follow.
inline void bindStorage(int binding, const Buffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(binding), buffer.name());
}

// A colour texture with a framebuffer.

// A picture that can be drawn into, used as a texture and read back. Throws Error where the driver
// cannot draw into that format and size. It has no depth buffer.
class Target {
  public:
    Target(GLenum format, glm::ivec2 sizePixels);
    // OpenGL's names of its framebuffer and its texture, and its size.
    [[nodiscard]] unsigned framebuffer() const { return framebuffer_.name(); }
    [[nodiscard]] unsigned texture() const { return colour_.name(); }
    [[nodiscard]] glm::ivec2 sizePixels() const { return size_; }

  private:
    glm::ivec2 size_;
    Texture colour_;
    Framebuffer framebuffer_;
};

// Reads back red, green and blue of every pixel, top row first, in the range of the sample type: 0
// to 255, 0 to 65535, or as stored. Waits for the GPU.
template <class Sample>  // std::uint8_t, std::uint16_t or float
[[nodiscard]] std::vector<Sample> readRgb(const Target& target);

// Returns when the GPU has finished all that was submitted in the current context.
void waitForGpu();

}  // namespace aquarama::gl
