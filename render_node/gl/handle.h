// SPDX-License-Identifier: Apache-2.0
// Owners of OpenGL names.
#pragma once

#include <utility>

#include <epoxy/gl.h>

namespace aquarama::gl {

// Sole owner of one OpenGL name. Traits supply create() or create(kind), and destroy(name).
// Must be destroyed while its context is current.
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

    [[nodiscard]] unsigned name() const { return name_; }

  private:
    unsigned name_;
};

struct BufferTraits {
    static unsigned create() {
        unsigned name = 0;
        glCreateBuffers(1, &name);
        return name;
    }
    static void destroy(unsigned name) { glDeleteBuffers(1, &name); }
};
struct TextureTraits {
    static unsigned create(GLenum target) {
        unsigned name = 0;
        glCreateTextures(target, 1, &name);
        return name;
    }
    static void destroy(unsigned name) { glDeleteTextures(1, &name); }
};
struct FramebufferTraits {
    static unsigned create() {
        unsigned name = 0;
        glCreateFramebuffers(1, &name);
        return name;
    }
    static void destroy(unsigned name) { glDeleteFramebuffers(1, &name); }
};
struct VertexArrayTraits {
    static unsigned create() {
        unsigned name = 0;
        glCreateVertexArrays(1, &name);
        return name;
    }
    static void destroy(unsigned name) { glDeleteVertexArrays(1, &name); }
};
struct SamplerTraits {
    static unsigned create() {
        unsigned name = 0;
        glCreateSamplers(1, &name);
        return name;
    }
    static void destroy(unsigned name) { glDeleteSamplers(1, &name); }
};
struct ProgramTraits {
    static unsigned create() { return glCreateProgram(); }
    static void destroy(unsigned name) { glDeleteProgram(name); }
};

using Buffer = Handle<BufferTraits>;
using Texture = Handle<TextureTraits>;
using Sampler = Handle<SamplerTraits>;
using Framebuffer = Handle<FramebufferTraits>;
using VertexArray = Handle<VertexArrayTraits>;
using ProgramHandle = Handle<ProgramTraits>;

}  // namespace aquarama::gl
