// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/gpu/stage_clock.h"

#include <algorithm>
#include <ctime>

#include <epoxy/gl.h>

#include "tests/bench/gpu/query_answer.h"

namespace aquarama::bench {

namespace {

StageClock* running = nullptr;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void APIENTRY onPush(GLenum /*source*/, GLuint /*id*/, GLsizei /*length*/, const GLchar* name) {
    running->enter(name);
}

void APIENTRY onPop() {
    running->leave();
}

// The first call through libepoxy's pointer writes the driver's function into it, over ours.
void resolve() {
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, "stage clock");
    glPopDebugGroup();
}

double cpuMilliseconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

// The first query of a mark is of the time.
constexpr std::array<GLenum, 4> kCounted{GL_VERTEX_SHADER_INVOCATIONS,
                                         GL_CLIPPING_OUTPUT_PRIMITIVES,
                                         GL_FRAGMENT_SHADER_INVOCATIONS,
                                         GL_COMPUTE_SHADER_INVOCATIONS};

StageWork workOf(const std::array<unsigned, 5>& queries) {
    return {answerOf(queries[1]), answerOf(queries[2]), answerOf(queries[3]), answerOf(queries[4])};
}

struct Pointers {
    decltype(epoxy_glPushDebugGroup) push;
    decltype(epoxy_glPopDebugGroup) pop;
};
Pointers drivers{};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

}  // namespace

StageWork& StageWork::operator+=(const StageWork& other) {
    vertices += other.vertices;
    primitives += other.primitives;
    fragments += other.fragments;
    computed += other.computed;
    return *this;
}

StageClock::StageClock(Clocked clocked) : clocked_{clocked} {
    resolve();
    drivers = {epoxy_glPushDebugGroup, epoxy_glPopDebugGroup};
    running = this;
    epoxy_glPushDebugGroup = onPush;
    epoxy_glPopDebugGroup = onPop;
}

StageClock::~StageClock() {
    epoxy_glPushDebugGroup = drivers.push;
    epoxy_glPopDebugGroup = drivers.pop;
    running = nullptr;
    for (const auto& queries : queries_)
        glDeleteQueries(static_cast<GLsizei>(queries.size()), queries.data());
}

void StageClock::endCounting() const {
    if (!marks_.empty())
        for (const GLenum counted : kCounted) glEndQuery(counted);
}

void StageClock::mark() {
    endCounting();
    if (clocked_ == Clocked::Finished) glFinish();
    if (marks_.size() == queries_.size()) {
        auto& queries = queries_.emplace_back();
        // Mesa's glCreateQueries() knows no pipeline statistics.
        glGenQueries(static_cast<GLsizei>(queries.size()), queries.data());
    }
    const auto& queries = queries_[marks_.size()];
    marks_.push_back({queries, open_.empty() ? "other" : open_.back(), cpuMilliseconds()});
    glQueryCounter(queries[0], GL_TIMESTAMP);
    for (std::size_t i = 0; i < kCounted.size(); ++i) glBeginQuery(kCounted[i], queries.at(i + 1));
}

void StageClock::begin() {
    marks_.clear();
    mark();
}

void StageClock::enter(const char* stage) {
    open_.emplace_back(stage);
    mark();
}

void StageClock::leave() {
    open_.pop_back();
    mark();
}

std::map<std::string, StageTime> StageClock::end() {
    mark();
    endCounting();
    std::map<std::string, StageTime> times;
    for (std::size_t i = 0; i + 1 < marks_.size(); ++i) {
        const Mark& here = marks_[i];
        const Mark& next = marks_[i + 1];
        StageTime& stage = times[here.stage];
        const std::uint64_t before = answerOf(here.queries[0]);
        stage.gpu +=
            static_cast<double>(std::max(answerOf(next.queries[0]), before) - before) / 1e6;
        stage.cpu += next.cpuMs - here.cpuMs;
        stage.work += workOf(here.queries);
    }
    return times;
}

}  // namespace aquarama::bench
