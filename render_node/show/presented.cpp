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

std::vector<FoodParticle> presentedFood(const StateFrame& frame) {
    const bool between = frame.foodBefore.size() == frame.foodAfter.size();
    std::vector<FoodParticle> food;
    food.reserve(frame.foodAfter.size());
    for (std::size_t i = 0; i < frame.foodAfter.size(); ++i) {
        const FoodRecord after = frame.foodAfter[i];
        if (after.kind() == FoodRecord::Kind::None) continue;
        const FoodRecord before = between ? frame.foodBefore[i] : after;
        const bool isSame =
            before.kind() == after.kind() && before.generation() == after.generation();
        const glm::vec3 to = after.offsetMetres();
        const glm::vec3 from = isSame ? before.offsetMetres() : to;
        food.push_back({frame.foodOriginMetres + glm::mix(from, to, frame.fraction),
                        static_cast<std::uint32_t>(4 * i + after.generation()),
                        after.kind() == FoodRecord::Kind::Pellet});
    }
    return food;
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
