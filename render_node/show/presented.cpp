// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/presented.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace aquarama {

std::vector<PresentedFish> presentedFish(const StateFrame& frame,
                                         std::span<const FishTraits> school) {
    // Without a tick before, the frame shows the tick itself.
    const bool between = frame.before.size() == frame.after.size();
    const std::vector<FishRecord>& before = between ? frame.before : frame.after;
    const float fraction = between ? frame.fraction : 1.0F;
    std::vector<PresentedFish> fish;
    const std::size_t count = std::min(frame.after.size(), school.size());
    fish.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        fish.push_back(present(before[i], frame.after[i], fraction, school[i]));
    return fish;
}

double presentedSeconds(const StateFrame& frame) {
    const double ticks =
        static_cast<double>(frame.tick.value) - 1 + static_cast<double>(frame.fraction);
    return std::max(ticks, 0.0) / kTicksPerSecond;
}

glm::dmat4 wallFromWorld(const Eye& eye) {
    const glm::dmat4 wallFromWorldRotation =
        glm::mat4_cast(glm::conjugate(glm::dquat(eye.worldFromWall)));
    return glm::translate(wallFromWorldRotation, -glm::dvec3(eye.positionMetres));
}

}  // namespace aquarama
