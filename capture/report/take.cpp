// SPDX-License-Identifier: Apache-2.0
#include "capture/report/take.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>

#include "capture/measure.h"
#include "common/base/log.h"
#include "common/base/units.h"

namespace aquarama::report {

namespace {

const motion::ActionSegment& segmentOf(const motion::Repertoire& repertoire,
                                       motion::Action action) {
    return repertoire.segments.at(static_cast<std::size_t>(action));
}

// Interpolated; `share` 0 gives a, 1 gives b. The time is left to the caller.
TakeFrame between(const capture::ReplayedPhase& a, const capture::ReplayedPhase& b, double share) {
    TakeFrame frame{.seconds = 0,
                    .origin = glm::mix(a.origin, b.origin, share),
                    .worldFromBody = glm::slerp(a.worldFromBody, b.worldFromBody, share),
                    .nodes = {}};
    for (std::size_t i = 0; i < frame.nodes.size(); ++i)
        frame.nodes.at(i) = glm::mix(a.nodes.at(i), b.nodes.at(i), share);
    return frame;
}

// The frame at a fractional index of the phases. An index beyond the last phase, as rounding makes
// it, gives the last phase.
TakeFrame frameAt(const std::vector<capture::ReplayedPhase>& phases, double at) {
    const auto before = std::min(static_cast<std::size_t>(at), phases.size() - 2);
    return between(
        phases[before], phases[before + 1], std::min(at - static_cast<double>(before), 1.0));
}

// Converts body lengths to metres.
void scale(TakeFrame& frame, double metres) {
    frame.origin *= metres;
    for (glm::dvec3& node : frame.nodes) node *= metres;
}

// `frames` frames from phase 0 on. They may not reach beyond the end of the last cycle.
Take makeTake(const motion::Repertoire& repertoire,
              motion::Action action,
              int cycles,
              std::size_t frames,
              double secondsPerFrame) {
    assert(cycles >= 1);
    assert(frames >= 1);
    const motion::ActionSegment& segment = segmentOf(repertoire, action);
    Take take{.species = repertoire.species,
              .segment = motion::nameOf(action),
              .lengthMetres = static_cast<double>(repertoire.recordedLengthMetres),
              .frames = {}};
    // In body lengths; frames are scaled to metres below.
    const std::vector<capture::ReplayedPhase> phases = capture::replayAlongX(segment, cycles);
    for (std::size_t i = 0; i < frames; ++i) {
        const double seconds = static_cast<double>(i) * secondsPerFrame;
        TakeFrame frame =
            frameAt(phases, seconds * motion::kPhases / static_cast<double>(segment.periodSeconds));
        frame.seconds = seconds;
        scale(frame, take.lengthMetres);
        take.frames.push_back(frame);
    }
    return take;
}

}  // namespace

Take takeAtTicks(const motion::Repertoire& repertoire, motion::Action action, int cycles) {
    // A cycle that ends at a tick, but for rounding, includes the frame at that tick.
    constexpr double kRounding = 1e-6;  // ticks
    const double ticks =
        static_cast<double>(segmentOf(repertoire, action).periodSeconds) * kTicksPerSecond * cycles;
    const std::size_t frames = static_cast<std::size_t>(std::floor(ticks + kRounding)) + 1;
    if (frames > kMostFrames)
        throw Error(std::to_string(cycles) + " cycles of " + motion::nameOf(action) + " are " +
                    std::to_string(frames) + " frames, a file can have " +
                    std::to_string(kMostFrames) + "; ask for fewer with --cycles");
    return makeTake(repertoire, action, cycles, frames, 1 / kTicksPerSecond);
}

Take takeAtPhases(const motion::Repertoire& repertoire,
                  motion::Action action,
                  int cycles,
                  int framesPerCycle) {
    assert(cycles >= 1);
    assert(framesPerCycle >= 1);
    const auto frames = static_cast<std::size_t>(cycles * framesPerCycle) + 1;
    return makeTake(
        repertoire,
        action,
        cycles,
        frames,
        static_cast<double>(segmentOf(repertoire, action).periodSeconds) / framesPerCycle);
}

}  // namespace aquarama::report
