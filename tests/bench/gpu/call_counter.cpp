// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/gpu/call_counter.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>

#include "tests/bench/gpu/card_memory.h"
#include "tests/bench/gpu/query_answer.h"

namespace aquarama::bench {

namespace {

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables)
CallCounter* running = nullptr;
ShaderLog* runningLog = nullptr;
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

constexpr std::array<GLenum, 5> kCounted{GL_VERTEX_SHADER_INVOCATIONS,
                                         GL_CLIPPING_OUTPUT_PRIMITIVES,
                                         GL_FRAGMENT_SHADER_INVOCATIONS,
                                         GL_COMPUTE_SHADER_INVOCATIONS,
                                         GL_SAMPLES_PASSED};

std::string labelOf(unsigned program) {
    std::array<char, 256> label{};
    glGetObjectLabel(GL_PROGRAM, program, label.size(), nullptr, label.data());
    return label.data();
}

int attachmentBits(unsigned framebuffer, GLenum attachment, std::initializer_list<GLenum> sizes) {
    GLint type = GL_NONE;
    glGetNamedFramebufferAttachmentParameteriv(
        framebuffer, attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
    int sum = 0;
    for (const GLenum size : sizes) {
        GLint bits = 0;
        if (type != GL_NONE)
            glGetNamedFramebufferAttachmentParameteriv(framebuffer, attachment, size, &bits);
        sum += bits;
    }
    return sum;
}

int colourBytes(unsigned framebuffer) {
    return attachmentBits(framebuffer,
                          GL_COLOR_ATTACHMENT0,
                          {GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE,
                           GL_FRAMEBUFFER_ATTACHMENT_GREEN_SIZE,
                           GL_FRAMEBUFFER_ATTACHMENT_BLUE_SIZE,
                           GL_FRAMEBUFFER_ATTACHMENT_ALPHA_SIZE}) /
           8;
}

int depthBytes(unsigned framebuffer) {
    return attachmentBits(
               framebuffer, GL_DEPTH_ATTACHMENT, {GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE}) /
           8;
}

int samplesOf(unsigned framebuffer) {
    GLint samples = 0;
    glGetNamedFramebufferParameteriv(framebuffer, GL_SAMPLES, &samples);
    return std::max(samples, 1);
}

int bound(GLenum what) {
    GLint name = 0;
    glGetIntegerv(what, &name);
    return name;
}

// A function of OpenGL, which libepoxy calls by a pointer, and what is called instead of it.
template <auto& pointer, class Function = std::remove_reference_t<decltype(pointer)>>
struct StandIn;
template <auto& pointer, class... Arguments>
struct StandIn<pointer, void (*)(Arguments...)> {
    // NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
    static inline void (*driver)(Arguments...) = nullptr;

    static void counted(Arguments... arguments) {
        running->count([&] { call(arguments...); });
    }
    // At the first call libepoxy finds the driver's function and writes it into the pointer.
    static void call(Arguments... arguments) {
        const auto instead = std::exchange(pointer, driver);
        pointer(arguments...);
        driver = std::exchange(pointer, instead);
    }
    static void begin(void (*instead)(Arguments...) = counted) {
        driver = std::exchange(pointer, instead);
    }
    static void end() { pointer = driver; }
};

using Label = StandIn<epoxy_glObjectLabel>;
using Push = StandIn<epoxy_glPushDebugGroup>;
using Pop = StandIn<epoxy_glPopDebugGroup>;
using Copy = StandIn<epoxy_glBlitNamedFramebuffer>;
using Mipmaps = StandIn<epoxy_glGenerateTextureMipmap>;
using Upload = StandIn<epoxy_glNamedBufferSubData>;

void onPush(GLenum /*source*/, GLuint /*id*/, GLsizei /*length*/, const GLchar* name) {
    running->enter(name);
}

void onPop() {
    running->leave();
}

void onLabel(GLenum kind, GLuint name, GLsizei length, const GLchar* label) {
    Label::call(kind, name, length, label);
    if (kind == GL_PROGRAM) runningLog->belongsTo(label);
}

// The parameters are those of OpenGL.
// NOLINTNEXTLINE(readability-function-size)
void onCopy(GLuint from,
            GLuint to,
            GLint x0,
            GLint y0,
            GLint x1,
            GLint y1,
            GLint toX0,
            GLint toY0,
            GLint toX1,
            GLint toY1,
            GLbitfield layers,
            GLenum filter) {
    const auto bytesOf = [&](unsigned framebuffer) {
        const int colour = (layers & GL_COLOR_BUFFER_BIT) != 0 ? colourBytes(framebuffer) : 0;
        const int depth = (layers & GL_DEPTH_BUFFER_BIT) != 0 ? depthBytes(framebuffer) : 0;
        return static_cast<std::uint64_t>((colour + depth) * samplesOf(framebuffer)) *
               static_cast<std::uint64_t>((x1 - x0) * (y1 - y0));
    };
    running->addBytes("copy", bytesOf(from) + bytesOf(to), samplesOf(from));
    Copy::call(from, to, x0, y0, x1, y1, toX0, toY0, toX1, toY1, layers, filter);
}

// The first level is read, the others are written.
void onMipmaps(GLuint texture) {
    running->addBytes("mipmaps", static_cast<std::uint64_t>(textureBytes(texture)));
    Mipmaps::call(texture);
}

void onUpload(GLuint buffer, GLintptr offset, GLsizeiptr size, const void* data) {
    running->addBytes("upload", static_cast<std::uint64_t>(size));
    Upload::call(buffer, offset, size, data);
}

template <auto&... pointers>
struct Calls {
    static void begin() { (StandIn<pointers>::begin(), ...); }
    static void end() { (StandIn<pointers>::end(), ...); }
};
using Drawing = Calls<epoxy_glDrawArrays,
                      epoxy_glDrawArraysInstanced,
                      epoxy_glDrawElements,
                      epoxy_glDrawElementsBaseVertex,
                      epoxy_glMultiDrawElementsIndirect,
                      epoxy_glDispatchCompute,
                      epoxy_glDispatchComputeIndirect>;

}  // namespace

CallWork& CallWork::operator+=(const CallWork& other) {
    calls += other.calls;
    work += other.work;
    samples += other.samples;
    bytes += other.bytes;
    return *this;
}

CallCounter::CallCounter(ShaderLog& log) : log_{log} {
    running = this;
    runningLog = &log;
    Drawing::begin();
    Label::begin(onLabel);
    Push::begin(onPush);
    Pop::begin(onPop);
    Copy::begin(onCopy);
    Mipmaps::begin(onMipmaps);
    Upload::begin(onUpload);
}

CallCounter::~CallCounter() {
    Upload::end();
    Mipmaps::end();
    Copy::end();
    Pop::end();
    Push::end();
    Label::end();
    Drawing::end();
    running = nullptr;
    runningLog = nullptr;
    for (const Queries& queries : queries_)
        glDeleteQueries(static_cast<GLsizei>(queries.size()), queries.data());
}

CallCounter::Queries CallCounter::freeQueries() {
    if (counted_.size() == queries_.size()) {
        Queries& queries = queries_.emplace_back();
        // Mesa's glCreateQueries() knows no pipeline statistics.
        glGenQueries(static_cast<GLsizei>(queries.size()), queries.data());
    }
    return queries_[counted_.size()];
}

template <class Call>
void CallCounter::count(const Call& call) {
    const auto target = static_cast<unsigned>(bound(GL_DRAW_FRAMEBUFFER_BINDING));
    const int colour = target == 0 ? 0 : colourBytes(target);
    const int depth = target == 0 ? 0 : depthBytes(target);
    CallKind kind{stage(),
                  labelOf(static_cast<unsigned>(bound(GL_CURRENT_PROGRAM))),
                  target == 0 ? 0 : samplesOf(target),
                  colour > 0 ? colour : depth};
    const Queries queries = freeQueries();
    for (std::size_t i = 0; i < kCounted.size(); ++i) glBeginQuery(kCounted.at(i), queries.at(i));
    call();
    for (const GLenum counted : kCounted) glEndQuery(counted);
    log_.belongsTo(kind.program);
    counted_.push_back({std::move(kind), queries});
}

void CallCounter::addBytes(const char* what, std::uint64_t bytes, int samples) {
    bytes_[{stage(), what, samples}] += {.calls = 1, .work = {}, .bytes = bytes};
}

CallCounts CallCounter::take() {
    CallCounts counts = std::exchange(bytes_, {});
    for (const auto& [kind, queries] : counted_) {
        StageWork work{
            answerOf(queries[0]), answerOf(queries[1]), answerOf(queries[2]), answerOf(queries[3])};
        // llvmpipe now and then tells fragments of a call before.
        if (work.primitives == 0) work.fragments = 0;
        counts[kind] += {.calls = 1, .work = work, .samples = answerOf(queries[4])};
    }
    counted_.clear();
    return counts;
}

}  // namespace aquarama::bench
