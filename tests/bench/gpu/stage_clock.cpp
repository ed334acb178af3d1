// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/gpu/stage_clock.h"

#include <algorithm>
#include <ctime>

#include <epoxy/gl.h>

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

struct Pointers {
    decltype(epoxy_glPushDebugGroup) push;
    decltype(epoxy_glPopDebugGroup) pop;
};
Pointers drivers{};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

}  // namespace

StageClock::StageClock() {
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
    glDeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
}

void StageClock::mark() {
    if (marks_.size() == queries_.size()) {
        queries_.push_back(0);
        glCreateQueries(GL_TIMESTAMP, 1, &queries_.back());
    }
    marks_.push_back(
        {queries_[marks_.size()], open_.empty() ? "other" : open_.back(), cpuMilliseconds()});
    glQueryCounter(marks_.back().query, GL_TIMESTAMP);
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
    std::map<std::string, StageTime> times;
    GLuint64 before = 0;
    for (std::size_t i = 0; i < marks_.size(); ++i) {
        GLuint64 now = 0;
        glGetQueryObjectui64v(marks_[i].query, GL_QUERY_RESULT, &now);
        if (i > 0) {
            StageTime& stage = times[marks_[i - 1].stage];
            stage.gpu += static_cast<double>(std::max(now, before) - before) / 1e6;
            stage.cpu += marks_[i].cpuMs - marks_[i - 1].cpuMs;
        }
        before = now;
    }
    return times;
}

}  // namespace aquarama::bench
