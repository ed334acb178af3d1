// SPDX-License-Identifier: Apache-2.0
#include "common/motion/gait_path.h"
#include "common/motion/orientation.h"
#include "common/motion/repertoire.h"

namespace aquarama::motion {
namespace {

// The mean of two poses, point by point.
template <class Pose>
Pose meanOf(const Pose& a, const Pose& b) {
    Pose mean{};
    for (std::size_t i = 0; i < mean.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            mean[i][axis] = static_cast<std::int16_t>(roundToEven((a[i][axis] + b[i][axis]) / 2.0));
    return mean;
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

    // A turn ends almost straight, with all muscles at rest; its mirror image bends to the other
    // side. The mean of a beat would be straight too, but short: half the muscles pull all the
    // time.
    const ActionSegment& left =
        repertoire.segments[static_cast<std::size_t>(Action::TurnLeftGradual)];
    const ActionSegment& right =
        repertoire.segments[static_cast<std::size_t>(Action::TurnRightGradual)];
    glide.nodes.fill(meanOf(left.nodes.back(), right.nodes.back()));
    if (medium.controlPoints.empty()) return;
    glide.controlPoints.assign(kPhases,
                               meanOf(left.controlPoints.back(), right.controlPoints.back()));
}

}  // namespace aquarama::motion
