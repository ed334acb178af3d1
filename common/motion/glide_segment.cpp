// SPDX-License-Identifier: Apache-2.0
#include "common/motion/gait_path.h"
#include "common/motion/orientation.h"
#include "common/motion/repertoire.h"

namespace aquarama {
namespace {

// The mean of a cycle, point by point: swimming is its own mirror image half a beat later, so this
// is a straight fish.
template <class Poses, class Pose>
void setMean(const Poses& poses, Pose& mean) {
    for (std::size_t i = 0; i < mean.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double sum = 0;
            for (const Pose& pose : poses) sum += pose[i][axis];
            mean[i][axis] = static_cast<std::int16_t>(roundToEven(sum / kPhases));
        }
    }
}

}  // namespace

void addGlide(Repertoire& repertoire) {
    const ActionSegment& medium =
        repertoire.segments[static_cast<std::size_t>(Action::ForwardMedium)];
    ActionSegment& glide = repertoire.segments[static_cast<std::size_t>(Action::Glide)];
    glide = {};
    glide.periodSeconds = medium.periodSeconds;

    const GaitPath path = pathOf(medium);
    double forward = 0;
    for (std::size_t k = 0; k < kPhases; ++k) forward += path.mean[k].forward;
    glide.increments.fill({{1, 0, 0, 0}, {static_cast<float>(forward / kPhases), 0, 0}});

    setMean(medium.nodes, glide.nodes[0]);
    glide.nodes.fill(NodalPose(glide.nodes[0]));
    if (medium.controlPoints.empty()) return;
    ControlPointPose straight{};
    setMean(medium.controlPoints, straight);
    glide.controlPoints.assign(kPhases, straight);
}

}  // namespace aquarama
