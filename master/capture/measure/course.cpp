// SPDX-License-Identifier: Apache-2.0
#include "master/capture/measure/course.h"

#include "common/motion/gait_path.h"

namespace aquarama::capture {

std::vector<ReplayedPhase> replayAlongX(const motion::ActionSegment& segment, int cycles) {
    const glm::dquat meanFromBody = glm::conjugate(motion::pathOf(segment).bodyFromMean[0]);
    std::vector<ReplayedPhase> phases = replay(segment, cycles);
    for (ReplayedPhase& phase : phases) {
        phase.origin = meanFromBody * phase.origin;
        phase.worldFromBody = meanFromBody * phase.worldFromBody;
        for (glm::dvec3& node : phase.nodes) node = meanFromBody * node;
    }
    return phases;
}

}  // namespace aquarama::capture
